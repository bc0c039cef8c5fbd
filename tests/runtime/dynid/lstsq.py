# SPDX-License-Identifier: MIT
"""Solves W beta = tau by numpy's lstsq: lstsq.py FILE, rows of W with tau as the last column."""
import sys

import numpy

rows = numpy.loadtxt(sys.argv[1], delimiter=",", ndmin=2)
beta = numpy.linalg.lstsq(rows[:, :-1], rows[:, -1], rcond=None)[0]
for value in beta:
    print(repr(float(value)))
