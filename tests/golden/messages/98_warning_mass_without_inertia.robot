number_link 2
dh standard
al pi/2 0
m 1 2
mX 0.3 0.2
YY 0 0
ZZ 1 0
gz 9.81
stop
