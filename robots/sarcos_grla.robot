# SPDX-License-Identifier: MIT
# Sarcos GRLA (General Robotic Large Arm), seven joints, gravity model of the thesis "Dynamic
# estimation for serial manipulators" (1995).
#
# Kinematics  thesis, Table 6.2. These are standard (distal) frames: joint i turns about z(i-1),
#             and the first moments are about the origin of frame i, beyond the link. The base
#             leans by 45 degrees.
# Gravity     first moments and base acceleration as defined in the C listing of Appendix B (Table
#             7.6 prints the same numbers rounded).
# Inertia     0: Table 7.6 identifies gravity parameters only (section 6.3.2). Use this file for
#             gravity, not for motion: it has no inertia and friction. The links' masses are 0 too:
#             their weight is grouped into the first moments.

name        sarcos_grla
number_link 7
dh          standard

sigma         0     0       0     0      0     0   0  # 0 revolute, 1 prismatic
al         pi/2  pi/2   -pi/2  pi/2  -pi/2  pi/2  pi  # alpha [rad]
d             0     0       0     0      0     0   0  # [m]
th            0     0       0     0      0     0   0  # added to q [rad]
r             0     0  0.8788     0  0.762     0   0  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m               0        0        0        0       0        0        0
mX         3.7467   5.3212  -2.5465   0.4624  0.2526  -0.1174  -1.7239
mY              0        0        0        0       0        0  -0.3668
mZ         3.7196  78.0962   3.9049  23.1605  0.6161  -0.0052        0
XX              0        0        0        0       0        0        0
XY              0        0        0        0       0        0        0
XZ              0        0        0        0       0        0        0
YY              0        0        0        0       0        0        0
YZ              0        0        0        0       0        0        0
ZZ              0        0        0        0       0        0        0

IA         0  0  0  0  0  0  0  # rotor inertia at the joint [kg m^2]
Fs         0  0  0  0  0  0  0  # Coulomb friction [N m]
Fv         0  0  0  0  0  0  0  # viscous friction [N m s/rad]
off        0  0  0  0  0  0  0  # torque offset [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy -6.93567
gz 6.93567

stop
