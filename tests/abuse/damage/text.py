# SPDX-License-Identifier: MIT
"""Damage of the text of the file."""
import numpy as np

from damage.recording_file import kind, plain


@kind("comma")
def quoted_decimal_commas(record, random, arm):
    file = plain(record)
    file.columns = {name: ['"' + (f"{v:.7f}" if name == "time" else f"{v:.9g}").replace(".", ",") + '"'
                           for v in values] for name, values in file.columns.items()}
    return file


@kind("")
def semicolons(record, random, arm):
    file = plain(record)
    file.separator = ";"
    return file


@kind("unit")
def units_row(record, random, arm):
    file = plain(record)
    deg = random.random() < 0.5
    units = []
    for name in file.columns:
        if name == "time":
            units.append("s")
        elif name.startswith("tau"):
            units.append("N" if arm.prismatic[int(name[3:]) - 1] else "Nm")
        elif arm.prismatic[int(name[1:]) - 1]:
            units.append("m")
        else:
            units.append("deg" if deg else "rad")
            if deg:
                file.columns[name] *= 180 / np.pi
    file.edit = lambda text: text.replace("\n", "\n" + ",".join(units) + "\n", 1)
    return file


@kind("truncated")
def truncated(record, random, arm):
    file = plain(record)
    cut = int(random.integers(1, 60))
    file.edit = lambda text: text[:-cut]
    return file


@kind("header")
def headerless(record, random, arm):
    file = plain(record)
    file.edit = lambda text: text.split("\n", 1)[1]
    return file


@kind("column|cells|fields")
def column_missing_in_a_row(record, random, arm):
    file = plain(record)
    at = int(random.integers(10, len(record["t"])))

    def edit(text):
        lines = text.split("\n")
        lines[at] = lines[at].rsplit(",", 1)[0]
        return "\n".join(lines)
    file.edit = edit
    return file


@kind("number|word|found")
def words_among_numbers(record, random, arm):
    file = plain(record)
    name = random.choice(list(file.columns))
    values = [f"{v:.9g}" for v in file.columns[name]]
    for _ in range(int(random.integers(1, 5))):
        values[int(random.integers(5, len(values)))] = random.choice(["err", "--", "N/A", "0x1F"])
    file.columns[name] = values
    return file


@kind("")
def mark_and_returns(record, random, arm):
    file = plain(record)
    file.edit = lambda text: "\ufeff" + text.replace("\n", "\r\n")
    return file


@kind("q|column")
def column_absent(record, random, arm):
    file = plain(record)
    del file.columns[random.choice([c for c in file.columns if c != "time"])]
    return file


@kind("")
def columns_in_other_order(record, random, arm):
    file = plain(record)
    names = list(file.columns)
    random.shuffle(names)
    file.columns = {name: file.columns[name] for name in names}
    return file


@kind("empty|rows|header")
def nothing(record, random, arm):
    file = plain(record)
    empty = random.random() < 0.5
    file.edit = lambda text: "" if empty else text.split("\n", 1)[0] + "\n"
    return file
