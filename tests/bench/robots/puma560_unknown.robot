# SPDX-License-Identifier: MIT
# The Puma 560 with every inertial parameter unknown, without rotors and friction: what is
# timed is the code that has no zero to leave out.
name puma560_unknown
number_link 6
dh modified
sigma 0 0 0 0 0 0
al 0 -pi/2 0 pi/2 -pi/2 pi/2
d 0 0 0.4318 -0.0203 0 0
th 0 0 0 0 0 0
r 0 0.2435 -0.0934 0.4331 0 0
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
