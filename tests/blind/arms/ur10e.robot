# SPDX-License-Identifier: MIT
# An arm of the blind suite; ur10e.xml is the same geometry, written apart. Every parameter is unknown.

name        ur10e
number_link 6
dh          modified

sigma         0         0         0         0         0         0
al            0      pi/2         0         0      pi/2     -pi/2
d             0         0   -0.6127  -0.57155         0         0
th            0         0         0         0         0         0
r        0.1807         0         0   0.17415   0.11985   0.11655
m             *         *         *         *         *         *
mX            *         *         *         *         *         *
mY            *         *         *         *         *         *
mZ            *         *         *         *         *         *
XX            *         *         *         *         *         *
XY            *         *         *         *         *         *
XZ            *         *         *         *         *         *
YY            *         *         *         *         *         *
YZ            *         *         *         *         *         *
ZZ            *         *         *         *         *         *
IA            *         *         *         *         *         *
Fs            *         *         *         *         *         *
Fv            *         *         *         *         *         *
off           *         *         *         *         *         *
qmin   -180*deg  -180*deg  -150*deg  -180*deg  -180*deg  -180*deg
qmax    180*deg     0*deg   150*deg   180*deg   180*deg   180*deg
vmax          2         2         3         3         3         3
amax          6         6         8        14        14        18

gx 0
gy 0
gz 9.81

stop
