number_link 3
sigma 0 0 1
d 0 450 0.1
r 0 -120.5 0
qmin -3 -3 0
qmax 3 3 800
m 1 1 1
mX 0.1 60 0
ZZ 1 1 5e5
gy 9810
stop
