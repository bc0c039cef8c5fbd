# SPDX-License-Identifier: MIT
"""Ways in which recordings are damaged, a module for each kind of thing that is damaged.

Each way takes a recording and a random generator and returns what the file looks like; its words are what dynid may
say of it. The order of the modules is the order of the kinds.
"""
from damage import clean
from damage import stamps
from damage import positions
from damage import torques
from damage import velocities
from damage import text
from damage import amount
from damage import robots
from damage.recording_file import KINDS, plain, text_of

__all__ = ["KINDS", "plain", "text_of"]
