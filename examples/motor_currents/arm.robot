# An arm with two joints: the first turns about a horizontal axis, the second is parallel to it.
name        arm
number_link 2
sigma       0    0
al          pi/2 0
d           0    0.5
th          0    0
r           0    0
joints      shoulder elbow
qmin        -3   -3
qmax        3    3
gz          9.81
stop
