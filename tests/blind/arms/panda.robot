# SPDX-License-Identifier: MIT
# An arm of the blind suite; panda.xml is the same geometry, written apart. Every parameter is unknown.

name        panda
number_link 7
dh          modified

sigma         0         0         0         0         0        0         0
al            0     -pi/2      pi/2      pi/2     -pi/2     pi/2      pi/2
d             0         0         0    0.0825   -0.0825        0     0.088
th            0         0         0         0         0        0         0
r         0.333         0     0.316         0     0.384        0         0
m             *         *         *         *         *        *         *
mX            *         *         *         *         *        *         *
mY            *         *         *         *         *        *         *
mZ            *         *         *         *         *        *         *
XX            *         *         *         *         *        *         *
XY            *         *         *         *         *        *         *
XZ            *         *         *         *         *        *         *
YY            *         *         *         *         *        *         *
YZ            *         *         *         *         *        *         *
ZZ            *         *         *         *         *        *         *
IA            *         *         *         *         *        *         *
Fs            *         *         *         *         *        *         *
Fv            *         *         *         *         *        *         *
off           *         *         *         *         *        *         *
qmin   -166*deg  -101*deg  -166*deg  -176*deg  -166*deg   -1*deg  -166*deg
qmax    166*deg   101*deg   166*deg    -4*deg   166*deg  215*deg   166*deg
vmax          2         2         2         2       2.5      2.5       2.5
amax          8         6         8         8        12       14        16

gx 0
gy 0
gz 9.81

stop
