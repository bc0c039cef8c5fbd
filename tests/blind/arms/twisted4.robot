# SPDX-License-Identifier: MIT
# An arm of the blind suite; twisted4.xml is the same geometry, written apart. Every parameter is unknown.

name        twisted4
number_link 4
dh          modified

sigma         0         0         0         0
al            0    63*deg   -40*deg    75*deg
d             0      0.12      0.35       0.2
th            0    17*deg         0   -25*deg
r           0.3      0.05     -0.08      0.25
m             *         *         *         *
mX            *         *         *         *
mY            *         *         *         *
mZ            *         *         *         *
XX            *         *         *         *
XY            *         *         *         *
XZ            *         *         *         *
YY            *         *         *         *
YZ            *         *         *         *
ZZ            *         *         *         *
IA            *         *         *         *
Fs            *         *         *         *
Fv            *         *         *         *
off           *         *         *         *
qmin   -160*deg  -120*deg  -130*deg  -170*deg
qmax    160*deg   120*deg   130*deg   170*deg
vmax          2         2         3         4
amax          8         8        14        20

gx 0
gy 0
gz 9.81

stop
