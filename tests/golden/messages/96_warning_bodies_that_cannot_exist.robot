number_link 5
m 2 2 2 2 *
mX 0.2 0 0 0 0
mY 0 0 0 0 0
mZ 0 0 0 0.5 0
XX 1 1 1 1 -0.2
XY 0 0 0.6 0.4 0
XZ 0 0 0 0.2 0
YY 1 3 1 0.5 1
YZ 0 0 0 0.5 0
ZZ 1 1 1 0.9 1
gy 9.81
stop
