# SPDX-License-Identifier: MIT
# An arm of the blind suite; planar2.xml is the same geometry, written apart. Every parameter is unknown.

name        planar2
number_link 2
dh          modified

sigma         0         0
al            0         0
d             0      0.45
th            0         0
r             0         0
m             *         *
mX            *         *
mY            *         *
mZ            *         *
XX            *         *
XY            *         *
XZ            *         *
YY            *         *
YZ            *         *
ZZ            *         *
IA            *         *
Fs            *         *
Fv            *         *
off           *         *
qmin   -170*deg  -150*deg
qmax    170*deg   150*deg
vmax          3         4
amax         12        20

gx 0
gy 9.81
gz 0

stop
