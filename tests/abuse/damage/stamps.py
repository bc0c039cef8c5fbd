# SPDX-License-Identifier: MIT
"""Damage of the time stamps and of the order of rows."""
import numpy as np

from damage.recording_file import kind, plain, rows


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
