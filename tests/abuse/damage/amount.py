# SPDX-License-Identifier: MIT
"""Recordings that hold too little."""
from damage.recording_file import kind, plain, rows


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
