# SPDX-License-Identifier: MIT
"""Damage of torques, and of single values of any column."""
import numpy as np

from damage.recording_file import joint, kind, plain, two


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
