# SPDX-License-Identifier: MIT
"""Ways in which recordings are damaged. Each takes a recording and a random generator and returns what
the file looks like; its words are what dynid may say of it."""
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


# ---- nothing wrong

@kind("")
def clean(record, random, arm):
    return plain(record)


@kind("")
def clean_with_velocities(record, random, arm):
    return plain(record, velocities=True)


# ---- time

@kind("starts again|same time|sorted")
def time_restarts(record, random, arm):
    file = plain(record)
    at = int(random.uniform(0.2, 0.8) * len(record["t"]))
    file.columns["time"][at:] -= file.columns["time"][at]
    return file


@kind("gap")
def gap(record, random, arm):
    n = len(record["t"])
    begin, length = int(random.uniform(0.02, 0.95) * n), int(random.integers(6, 200))
    keep = np.ones(n, bool)
    keep[begin:begin + length] = False
    return rows(plain(record), keep)


@kind("gap|lost|missing|uniform|resampled")
def lost_samples(record, random, arm):
    keep = random.random(len(record["t"])) > random.uniform(0.001, 0.05)
    keep[0] = True
    return rows(plain(record), keep)


@kind("second time|twice")
def rows_twice(record, random, arm):
    index = np.sort(np.concatenate([np.arange(len(record["t"])),
                                    random.integers(0, len(record["t"]), random.integers(1, 60))]))
    return rows(plain(record), index)


@kind("sorted|out of order|increase")
def shuffled(record, random, arm):
    return rows(plain(record), random.permutation(len(record["t"])))


@kind("sorted|out of order|increase")
def neighbours_swapped(record, random, arm):
    index = np.arange(len(record["t"]))
    for k in random.integers(1, len(index) - 1, random.integers(1, 80)):
        index[[k, k + 1]] = index[[k + 1, k]]
    return rows(plain(record), index)


@kind("sorted|increase|starts again")
def reversed_rows(record, random, arm):
    return rows(plain(record), np.arange(len(record["t"]))[::-1])


def scaled_time(factor):
    def make(record, random, arm):
        file = plain(record)
        file.columns["time"] *= factor
        return file
    return make


for label, factor in (("milliseconds", 1e3), ("microseconds", 1e6), ("nanoseconds", 1e9)):
    make = scaled_time(factor)
    make.__name__ = label
    kind("seconds")(make)


@kind("uniform|resampled")
def jittered_stamps(record, random, arm):
    file = plain(record)
    step = record["t"][1] - record["t"][0]
    file.columns["time"] += random.uniform(0.01, 0.3) * step * random.standard_normal(len(record["t"]))
    return file


@kind("")
def unix_time(record, random, arm):
    file = plain(record)
    file.columns["time"] += 1.7e9
    return file


@kind("qd.*times|rate")
def rate_wrong(record, random, arm):
    file = plain(record, velocities=True)
    file.columns["time"] *= random.choice([0.5, 2, 1.25])
    return file


# ---- positions

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


def two(record, random):
    return random.choice(record["q"].shape[1], 2, replace=False) + 1


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


# ---- torque

@kind("throughout|not measured")
def dead_torque(record, random, arm):
    file = plain(record)
    file.columns[f"tau{joint(record, random) + 1}"][:] = 0
    return file


@kind("throughout|not measured")
def constant_torque(record, random, arm):
    file = plain(record)
    file.columns[f"tau{joint(record, random) + 1}"][:] = random.uniform(-20, 20)
    return file


@kind("sign|negative|leaves")
def torque_sign(record, random, arm):
    file = plain(record)
    file.columns[f"tau{joint(record, random) + 1}"] *= -1
    return file


@kind("sign|negative|leaves|gravity")
def torque_sign_of_all(record, random, arm):
    file = plain(record)
    for j in range(arm.joints):
        file.columns[f"tau{j + 1}"] *= -1
    return file


@kind("swapped|leaves|sign|negative")
def swapped_torques(record, random, arm):
    file = plain(record)
    a, b = two(record, random)
    file.columns[f"tau{a}"], file.columns[f"tau{b}"] = file.columns[f"tau{b}"], file.columns[f"tau{a}"]
    return file


@kind("stands twice")
def torque_twice(record, random, arm):
    file = plain(record)
    a, b = two(record, random)
    file.columns[f"tau{a}"] = file.columns[f"tau{b}"].copy()
    return file


@kind("N mm|mN m|taumax", arms=("planar2r", "elbow6r"))
def newton_millimetres(record, random, arm):
    file = plain(record)
    for j in range(arm.joints):
        file.columns[f"tau{j + 1}"] *= 1000
    return file


@kind("stuck|froze|one number|stands still")
def stuck_torque(record, random, arm):
    file = plain(record)
    tau = file.columns[f"tau{joint(record, random) + 1}"]
    begin = int(random.uniform(0.1, 0.7) * len(tau))
    tau[begin:begin + int(random.integers(60, 1200))] = tau[begin]
    return file


@kind("glitch|interpolated|stands off")
def torque_glitches(record, random, arm):
    file = plain(record)
    for _ in range(int(random.integers(1, 10))):
        tau = file.columns[f"tau{joint(record, random) + 1}"]
        tau[int(random.integers(20, len(tau) - 20))] = random.choice([-1, 1]) * random.uniform(10, 1e4) * np.abs(tau).max()
    return file


@kind("limit|clipped")
def clipped_torque(record, random, arm):
    file = plain(record)
    tau = file.columns[f"tau{joint(record, random) + 1}"]
    most = random.uniform(0.4, 0.8) * np.abs(tau).max()
    np.clip(tau, -most, most, out=tau)
    return file


@kind("late|early|lag")
def late_torque(record, random, arm):
    lag = int(random.integers(5, 25))
    file = plain(record)
    for j in range(arm.joints):
        tau = file.columns[f"tau{j + 1}"]
        file.columns[f"tau{j + 1}"] = np.concatenate([np.full(lag, tau[0]), tau[:-lag]])
    return file


@kind("bad rows|nan|gap|interpolated|left out")
def bursts_of_nan(record, random, arm):
    file = plain(record)
    for _ in range(int(random.integers(1, 20))):
        name = random.choice([c for c in file.columns if c != "time"])
        begin = int(random.integers(5, len(record["t"]) - 60))
        file.columns[name][begin:begin + int(random.integers(1, 40))] = np.nan
    return file


@kind("1e9|wild|beyond")
def wild_values(record, random, arm):
    file = plain(record)
    for _ in range(int(random.integers(1, 8))):
        name = random.choice([c for c in file.columns if c != "time"])
        file.columns[name][int(random.integers(len(record["t"])))] = random.choice([1e99, -1e12, np.inf])
    return file


# ---- velocities

@kind("qd")
def velocity_scaled(record, random, arm):
    file = plain(record, velocities=True)
    file.columns[f"qd{joint(record, random) + 1}"] *= random.choice([180 / np.pi, 0.5, 2, -1])
    return file


@kind("qd")
def velocity_late(record, random, arm):
    file = plain(record, velocities=True)
    name = f"qd{joint(record, random) + 1}"
    lag = int(random.integers(5, 20))
    file.columns[name] = np.concatenate([np.zeros(lag), file.columns[name][:-lag]])
    return file


# ---- text

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


# ---- too little

@kind("samples|short|equations|determine|filter|noise of accelerations")
def few_samples(record, random, arm):
    begin = int(random.integers(0, 1000))
    return rows(plain(record), slice(begin, begin + int(random.integers(2, 200))))


@kind("stand|moves|equations|determine")
def robot_stands(record, random, arm):
    file = plain(record)
    for j in range(arm.joints):
        file.columns[f"q{j + 1}"] = record["q"][0, j] + 1e-5 * random.standard_normal(len(record["t"]))
        file.columns[f"tau{j + 1}"] = record["tau"][0, j] + 0.1 * random.standard_normal(len(record["t"]))
    file.options = [[], ["--still", "0"]][int(random.integers(2))]
    return file


@kind("equations|determine|still")
def still_too_high(record, random, arm):
    file = plain(record)
    file.options = ["--still", str(random.uniform(3, 100))]
    return file


# ---- the robot file

@kind("gravity")
def gravity_absent(record, random, arm):
    file = plain(record)
    file.robot = lambda arm: arm.text(False).replace("gz 9.81\n", "").replace("gx 0\n", "").replace("gy 0\n", "")
    return file


@kind("gravity|negative|sign|axis")
def gravity_downward(record, random, arm):
    file = plain(record)
    file.robot = lambda arm: arm.text(False, gravity=-9.81)
    return file
