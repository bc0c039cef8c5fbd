# SPDX-License-Identifier: MIT
# An arm of the blind suite; puma560.xml is the same geometry, written apart. Every parameter is unknown.

name        puma560
number_link 6
dh          modified

sigma         0         0        0         0         0         0
al            0     -pi/2        0      pi/2     -pi/2      pi/2
d             0         0   0.4318   -0.0203         0         0
th            0         0        0         0         0         0
r             0    0.2435  -0.0934    0.4331         0         0
m             *         *        *         *         *         *
mX            *         *        *         *         *         *
mY            *         *        *         *         *         *
mZ            *         *        *         *         *         *
XX            *         *        *         *         *         *
XY            *         *        *         *         *         *
XZ            *         *        *         *         *         *
YY            *         *        *         *         *         *
YZ            *         *        *         *         *         *
ZZ            *         *        *         *         *         *
IA            *         *        *         *         *         *
Fs            *         *        *         *         *         *
Fv            *         *        *         *         *         *
off           *         *        *         *         *         *
qmin   -160*deg  -225*deg  -45*deg  -110*deg  -100*deg  -266*deg
qmax    160*deg    45*deg  225*deg   170*deg   100*deg   266*deg
vmax        1.4         1        2       2.6       2.3       4.5
amax          6         5       10        20        20        30

gx 0
gy 0
gz 9.81

stop
