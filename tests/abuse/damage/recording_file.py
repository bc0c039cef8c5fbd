# SPDX-License-Identifier: MIT
"""A recording on its way into a file, and the table of the kinds of damage done to it."""
import io
from dataclasses import dataclass, field
from typing import Callable

import numpy as np

KINDS = {}


@dataclass
class File:
    """A recording on its way into a file."""
    columns: dict               # name -> values or texts
    separator: str = ","
    head: list = field(default_factory=list)   # lines before the header
    edit: Callable = None       # text -> text
    robot: Callable = None      # Arm -> text of a robot file
    options: list = field(default_factory=list)


@dataclass
class Kind:
    name: str
    make: Callable
    words: str                  # a regular expression of what may be said
    arms: tuple = ("planar2r", "elbow6r", "gantry")


def kind(words, arms=("planar2r", "elbow6r", "gantry")):
    def add(function):
        KINDS[function.__name__] = Kind(function.__name__, function, words, arms)
        return function
    return add


def plain(record, velocities=False):
    columns = {"time": record["t"].copy()}
    for key, name in (("q", "q"), ("tau", "tau")) + ((("qd", "qd"),) if velocities else ()):
        for j in range(record[key].shape[1]):
            columns[f"{name}{j + 1}"] = record[key][:, j].copy()
    return File(columns)


def rows(file, keep):
    file.columns = {name: values[keep] for name, values in file.columns.items()}
    return file


def joint(record, random):
    return int(random.integers(record["q"].shape[1]))


def two(record, random):
    """Two different joints, from 1."""
    return random.choice(record["q"].shape[1], 2, replace=False) + 1


def revolute_columns(record, arm):
    return [f"q{j + 1}" for j in range(arm.joints) if not arm.prismatic[j]]


def text_of(file):
    out = io.StringIO()
    for line in file.head:
        out.write(line + "\n")
    out.write(file.separator.join(file.columns) + "\n")
    cells = []
    for name, values in file.columns.items():
        form = "%.7f" if name == "time" else "%.9g"
        cells.append([v if isinstance(v, str) else form % v for v in values])
    for row in zip(*cells):
        out.write(file.separator.join(row) + "\n")
    text = out.getvalue()
    return file.edit(text) if file.edit else text
