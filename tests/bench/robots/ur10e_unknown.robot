# SPDX-License-Identifier: MIT
# The UR10e with every inertial parameter unknown, without rotors and friction: what is
# timed is the code that has no zero to leave out.
name ur10e_unknown
number_link 6
dh modified
sigma 0 0 0 0 0 0
al 0 pi/2 0 0 pi/2 -pi/2
d 0 0 -0.6127 -0.57155 0 0
th 0 0 0 0 0 0
r 0.1807 0 0 0.17415 0.11985 0.11655
m * * * * * *
mX * * * * * *
mY * * * * * *
mZ * * * * * *
XX * * * * * *
XY * * * * * *
XZ * * * * * *
YY * * * * * *
YZ * * * * * *
ZZ * * * * * *
gx 0
gy 0
gz 9.81
stop
