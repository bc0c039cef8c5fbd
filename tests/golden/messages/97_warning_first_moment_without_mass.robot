number_link 2
m 0 1
mY 0.3 0.1
ZZ 1 1
gy 9.81
stop
