# one link that swings in a vertical plane
name        pendulum
number_link 1
sigma       0
al          0
d           0
th          0
r           0
mX          *
mY          *
ZZ          *
Fs          *
Fv          *
gx          9.81
gy          0
gz          0
stop
