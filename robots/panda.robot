# SPDX-License-Identifier: MIT
# Franka Emika Panda, seven joints.
#
# Kinematics  Denavit-Hartenberg parameters published by Franka (Franka Control Interface
#             documentation), modified (Craig) frames as there. Frame 7 lies on axis 7, 0.088 m
#             from axis 6; the flange stands 0.107 m further along z7.
# Limits      Franka Control Interface documentation, "Limits for Panda".
# Inertia     unknown ('*'), likewise IA, Fs and Fv: to be identified from recordings.

name        panda
number_link 7
dh          modified

sigma          0      0      0       0        0     0      0  # 0 revolute, 1 prismatic
al             0  -pi/2   pi/2    pi/2    -pi/2  pi/2   pi/2  # alpha [rad]
d              0      0      0  0.0825  -0.0825     0  0.088  # [m]
th             0      0      0       0        0     0      0  # added to q [rad]
r          0.333      0  0.316       0    0.384     0      0  # [m]

m          *  *  *  *  *  *  *  # mass [kg]
mX         *  *  *  *  *  *  *  # first moments about the frame origin [kg m]
mY         *  *  *  *  *  *  *
mZ         *  *  *  *  *  *  *
XX         *  *  *  *  *  *  *  # inertia about the frame origin [kg m^2]
XY         *  *  *  *  *  *  *
XZ         *  *  *  *  *  *  *
YY         *  *  *  *  *  *  *
YZ         *  *  *  *  *  *  *
ZZ         *  *  *  *  *  *  *

IA         *  *  *  *  *  *  *  # rotor inertia at the joint [kg m^2]
Fs         *  *  *  *  *  *  *  # Coulomb friction [N m]
Fv         *  *  *  *  *  *  *  # viscous friction [N m s/rad]
off        0  0  0  0  0  0  0  # torque offset [N m]

qmin       -2.8973  -1.7628  -2.8973  -3.0718  -2.8973  -0.0175  -2.8973  # [rad]
qmax        2.8973   1.7628   2.8973  -0.0698   2.8973   3.7525   2.8973
vmax         2.175    2.175    2.175    2.175     2.61     2.61     2.61  # [rad/s]
amax            15      7.5       10     12.5       15       20       20  # [rad/s^2]
taumax          87       87       87       87       12       12       12  # [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
