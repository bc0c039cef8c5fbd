# SPDX-License-Identifier: MIT
# PUMA 560, first three joints: the arm of the thesis "Dynamic estimation for serial manipulators"
# (1995).
#
# Kinematics  modified frames of the thesis's chapter 3 and Appendix A. The base parameters
#             contain the offset of shoulder and elbow along their axes, hence r = 0.
# Inertia     the 15 base parameters of the thesis's Table 7.1, motor inertias included (Armstrong,
#             Khatib and Burdick 1986). They are in the rows after which they are named.
#             They are grouped values, not the link's own: XX2 stands for XX2 - YY2 - L^2 M3, so
#             it may be negative. (The thesis does not print which P is which: matched by value.)
# Friction    none: Table 7.1 gives none.
# Limits      thesis, Table 5.1.
#
# Joint angles are the thesis's: theta = theta_AKB + (pi, pi, -pi), with theta_AKB of puma560.robot.
# The shift of joint 1 turns the arm about the vertical and changes no torque.

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

# IA is 0: the motor inertias are in ZZ1, ZZ2 and ZZ3 of Table 7.1
IA         0  0  0  # rotor inertia at the joint [kg m^2]
Fs         0  0  0  # Coulomb friction [N m]
Fv         0  0  0  # viscous friction [N m s/rad]
off        0  0  0  # torque offset [N m]

qmin       -160*deg  -35*deg  -225*deg  # [rad]
qmax        160*deg  215*deg    45*deg
taumax       131.44   228.57    113.86  # [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
