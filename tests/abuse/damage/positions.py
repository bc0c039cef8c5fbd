# SPDX-License-Identifier: MIT
"""Damage of positions: units, encoders, axes, delays."""
import numpy as np

from damage.recording_file import joint, kind, plain, revolute_columns, two


@kind("degrees|turns|span")
def degrees(record, random, arm):
    file = plain(record)
    for name in revolute_columns(record, arm):
        file.columns[name] *= 180 / np.pi
    return file


@kind("degrees|turns|span|left|leaves|residual", arms=("planar2r", "elbow6r"))
def degrees_of_one_joint(record, random, arm):
    file = plain(record)
    file.columns[random.choice(revolute_columns(record, arm))] *= 180 / np.pi
    return file


@kind("turns|degrees|leaves")
def turns(record, random, arm):
    file = plain(record)
    for name in revolute_columns(record, arm):
        file.columns[name] /= 2 * np.pi
    return file


@kind("millimetres|span|leaves", arms=("gantry",))
def millimetres(record, random, arm):
    file = plain(record)
    for j in np.flatnonzero(arm.prismatic):
        file.columns[f"q{j + 1}"] *= 1000
    return file


@kind("counts")
def encoder_counts(record, random, arm):
    file = plain(record)
    for j in range(arm.joints):
        file.columns[f"q{j + 1}"] = np.round(file.columns[f"q{j + 1}"] * 2 ** int(random.integers(12, 20)))
    return file


@kind("motor|degrees|counts|span|leaves")
def motor_side(record, random, arm):
    file = plain(record)
    for j in range(arm.joints):
        gear = random.uniform(20, 160)
        file.columns[f"q{j + 1}"] *= gear
        file.columns[f"tau{j + 1}"] /= gear
    return file


@kind("unwrapped|whole turn|wrapped", arms=("planar2r", "elbow6r"))
def wrapped(record, random, arm):
    file = plain(record)
    for name in revolute_columns(record, arm):
        q = file.columns[name]
        low = random.uniform(q.min(), q.max())  # where the encoder's turn ends
        file.columns[name] = (q - low) % (2 * np.pi) + low - 2 * np.pi * (low > 0)
    return file


def glitched(count):
    def make(record, random, arm):
        file = plain(record)
        for _ in range(count(random)):
            name = f"q{joint(record, random) + 1}"
            at = int(random.integers(20, len(record["t"]) - 20))
            file.columns[name][at] += random.choice([-1, 1]) * random.uniform(0.05, 3)
        return file
    return make


for label, count in (("glitch", lambda random: 1), ("glitches", lambda random: int(random.integers(2, 25)))):
    make = glitched(count)
    make.__name__ = label
    kind("glitch|interpolated|stands off|beside its neighbours")(make)


@kind("froze|stuck|frozen|stands still")
def frozen_position(record, random, arm):
    file = plain(record)
    q = file.columns[f"q{joint(record, random) + 1}"]
    begin = int(random.uniform(0.1, 0.8) * len(q))
    q[begin:begin + int(random.integers(30, 500))] = q[begin]
    return file


@kind("sign|axis|negative|leaves")
def position_sign(record, random, arm):
    file = plain(record)
    file.columns[f"q{joint(record, random) + 1}"] *= -1
    return file


@kind("swapped|leaves|sign|axis")
def swapped_positions(record, random, arm):
    file = plain(record)
    a, b = two(record, random)
    file.columns[f"q{a}"], file.columns[f"q{b}"] = file.columns[f"q{b}"], file.columns[f"q{a}"]
    return file


@kind("stands twice")
def position_twice(record, random, arm):
    file = plain(record)
    a, b = two(record, random)
    file.columns[f"q{a}"] = file.columns[f"q{b}"].copy()
    return file


@kind("late|early|lag|held|leaves")
def late_position(record, random, arm):
    file = plain(record)
    name = f"q{joint(record, random) + 1}"
    lag = int(random.integers(5, 25))
    file.columns[name] = np.concatenate([np.full(lag, file.columns[name][0]), file.columns[name][:-lag]])
    return file


@kind("held|lag|late")
def held_positions(record, random, arm):
    file = plain(record)
    hold = int(random.integers(2, 6))
    for j in range(arm.joints):
        q = file.columns[f"q{j + 1}"]
        file.columns[f"q{j + 1}"] = q[(np.arange(len(q)) // hold) * hold]
    return file


@kind("step|quant|leaves")
def coarse_encoder(record, random, arm):
    file = plain(record)
    step = random.uniform(2e-4, 2e-3)
    for j in range(arm.joints):
        file.columns[f"q{j + 1}"] = np.round(file.columns[f"q{j + 1}"] / step) * step
    return file
