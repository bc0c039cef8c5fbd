# Kinova Gen3, 7 joints: classical DH of the user guide, frame 0 with z down.
name gen3
number_link 7
dh standard
sigma 0 0 0 0 0 0 0
al pi/2 pi/2 pi/2 pi/2 pi/2 pi/2 pi
d  0 0 0 0 0 0 0
th 0 pi pi pi pi pi pi
r  -0.2848 -0.0118 -0.4208 -0.0128 -0.3143 0 -0.1674
m * * * * * * *
mX * * * * * * *
mY * * * * * * *
mZ * * * * * * *
XX * * * * * * *
XY * * * * * * *
XZ * * * * * * *
YY * * * * * * *
YZ * * * * * * *
ZZ * * * * * * *
IA * * * * * * *
Fs * * * * * * *
Fv * * * * * * *
off * * * * * * *
gz -9.81
stop
