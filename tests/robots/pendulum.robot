# SPDX-License-Identifier: MIT
# The smallest robot: one revolute joint about a horizontal axis, its numbers easy to check by hand.
name        pendulum
number_link 1
sigma       0
al          0
d           0
th          0
r           0
m           2
mX          1
ZZ          0.5
Fv          0.1
gx          9.81        # x points up at q = 0
stop
