number_link 3
d 0 0.5 0.5
m 2 2 2
mX 0 0.6 *
mY 0.6 0 0
mZ 0 0 0.6
XX 0.02 0.02 0.02
YY 0.2 0.02 0.2
ZZ 0.18 0.02 0.02
gy 9.81
stop
