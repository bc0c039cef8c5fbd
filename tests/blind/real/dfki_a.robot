# SPDX-License-Identifier: MIT
# The DFKI double pendulum, build A: two revolute joints about one horizontal direction.
#
# Kinematics  of the data set's description: the first link is 0.3 m long, q = 0 hangs, q2 is
#             relative.
# Inertia     unknown ('*'), likewise IA, Fs, Fv and off.

name        dfki_a
number_link 2
dh          modified

sigma         0         0
al            0         0
d             0       0.3
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

# base acceleration -g in frame 0 [m/s^2]: gravity along +x0, downwards at q = 0
gx -9.81
gy 0
gz 0

stop
