# SPDX-License-Identifier: MIT
"""Mistakes in the robot file."""
from damage.recording_file import kind, plain


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
