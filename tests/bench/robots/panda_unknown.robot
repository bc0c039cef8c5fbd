# SPDX-License-Identifier: MIT
# The Panda with every inertial parameter unknown, without rotors and friction: what is
# timed is the code that has no zero to leave out.
name panda_unknown
number_link 7
dh modified
sigma 0 0 0 0 0 0 0
al 0 -pi/2 pi/2 pi/2 -pi/2 pi/2 pi/2
d 0 0 0 0.0825 -0.0825 0 0.088
th 0 0 0 0 0 0 0
r 0.333 0 0.316 0 0.384 0 0
m * * * * * * *
mX * * * * * * *
mY * * * * * * *
mZ * * * * * * *
XX * * * * * * *
XY * * * * * * *
XZ * * * * * * *
YY * * * * * * *
YZ * * * * * * *
ZZ * * * * * * *
gx 0
gy 0
gz 9.81
stop
