# SPDX-License-Identifier: MIT
# The truth of the identification study: robots/puma560_3dof.robot (the arm of the 1995 thesis, its
# Table 7.1) with friction and offset.
#
# Inertia     as there; a 0 is grouped into another parameter and stays 0.
# Actuators   rotor inertia as there (in ZZ1, ZZ2, ZZ3), but for joint 3, where 0.2 are apart;
#             friction and offset made up, of the size of such drives.

name        puma560_3dof
number_link 3
dh          modified
joints      waist shoulder elbow
parameters  base
let         L 0.4318   # length of the upper arm [m]

sigma      0     0  0  # 0 revolute, 1 prismatic
al         0  pi/2  0  # alpha [rad]
d          0     0  L  # [m]
th         0     0  0  # added to q [rad]
r          0     0  0  # [m]

# Table 7.1: P1 ZZ1; P2 mX2, P3 mY2, P4 ZZ2, P5..P8 XX2 XY2 XZ2 YZ2; P9 mX3, P10 mY3, P11 ZZ3,
# P12..P15 XX3 XY3 XZ3 YZ3. A 0 has no effect on the torque, or is grouped into another.
m               0        0        0  # mass [kg]
mX              0    3.792   0.0254  # first moments about the frame origin [kg m]
mY              0    0.104   0.8632
mZ              0        0        0
XX              0  -1.3804   0.3006  # inertia about the frame origin [kg m^2]
XY              0   -0.007  -0.0106
XZ              0  -0.6889  -0.0038
YY              0        0        0
YZ              0  -0.0227  -0.1342
ZZ         3.9495    5.632   0.7491

# kg m^2, N m, N m s/rad, N m
IA         0  0  0.2
Fs       5.9  8.1  4.4
Fv       4.9  7.2  3.0
off      0.7 -1.2  0.5

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
