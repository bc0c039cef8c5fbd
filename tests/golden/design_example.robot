# The example of the format's documentation, with every kind of row.
name        puma560_arm            # optional, else the file's stem
number_link 3
dh          modified               # modified (Khalil, Craig; default) | standard
let L       0.4318
sigma       0 0 0                  # 0 revolute, 1 prismatic, 2 fixed
al          0 pi/2 0               # alpha
d           0 0    L               # a
th          0 0    0               # offset added to q (revolute)
r           0 0.1254 0             # added to q (prismatic)
ant         0 1    2               # optional: parent link, for tree robots
m           0 17.4 *               # ten inertial rows, about the frame origin
mX          0, 17.4*0.068, *
mY          0, 17.4*0.006, *
mZ          0, 17.4*(-0.016), *
XX          0 0.13 *
XY          0 0    *
XZ          0 0    *
YY          0 0.524 *
YZ          0 0    *
ZZ          * 0.539 *
IA          1.14 4.71 .83          # rotor inertia
Fs          * * *                  # Coulomb
Fv          1.48e-3 0.817e-3 1.38E-3
off         0 0 0
qmin        -160*deg -225*deg -45*deg
qmax        160*deg 45*deg 225*deg
vmax        8 10 10
amax        20 20 20
taumax      97.6 186.4 89.4
joints      shoulder upper elbow
gx 0
gy 0
gz 9.81                            # components of -g in frame 0
effect stribeck joint=2 Fs=2.1 vs=0.05
effect payload joint=3 m=*
stop
