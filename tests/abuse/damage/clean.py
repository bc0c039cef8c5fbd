# SPDX-License-Identifier: MIT
"""Recordings without damage."""
from damage.recording_file import kind, plain


@kind("")
def clean(record, random, arm):
    return plain(record)


@kind("")
def clean_with_velocities(record, random, arm):
    return plain(record, velocities=True)
