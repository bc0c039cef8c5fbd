number_link 3
m 1 0 0
mX 0 0 0
mY 0 0 0
mZ 0 0 0
XX 0 0 0
XY 0 0 0
XZ 0 0 0
YY 0 0 0
YZ 0 0 0
ZZ 1 0 0
IA * 0 0
gy 9.81
stop
