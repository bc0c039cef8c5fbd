# SPDX-License-Identifier: MIT
# Two links in a vertical plane, gravity along -y0: at q = 0 the joints carry
# 9.81 (mX1 + 0.5 m2 + mX2) = 9.81 * 3 and 9.81 mX2 = 9.81.
name        arm
number_link 2
sigma 0 0
al    0 0
d     0 0.5
th    0 0
r     0 0
m     4 2
mX    1 1
mY    0 0
mZ    0 0
XX    0 0
XY    0 0
XZ    0 0
YY    1 1
YZ    0 0
ZZ    1 1
gx 0
gy 9.81
gz 0
stop
