# SPDX-License-Identifier: MIT
"""Damage of velocities beside positions."""
import numpy as np

from damage.recording_file import joint, kind, plain


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
