# SPDX-License-Identifier: MIT
# Universal Robots UR10e, six joints.
#
# Kinematics  Denavit-Hartenberg parameters published by Universal Robots ("DH parameters for
#             calculations of kinematics and dynamics"), rewritten in modified frames; nominal,
#             not one robot's calibration. Frame 6 is the tool flange.
# Limits      Universal Robots: working range, joint speed, and maximum joint torques.
# Inertia     unknown ('*'), likewise IA, Fs and Fv: to be identified from recordings (the maker
#             publishes masses and centres of mass, but no inertia tensors).

name        ur10e
number_link 6
dh          modified
joints      shoulder_pan shoulder_lift elbow wrist_1 wrist_2 wrist_3

sigma           0     0        0         0        0        0  # 0 revolute, 1 prismatic
al              0  pi/2        0         0     pi/2    -pi/2  # alpha [rad]
d               0     0  -0.6127  -0.57155        0        0  # [m]
th              0     0        0         0        0        0  # added to q [rad]
r          0.1807     0        0   0.17415  0.11985  0.11655  # [m]

m          *  *  *  *  *  *  # mass [kg]
mX         *  *  *  *  *  *  # first moments about the frame origin [kg m]
mY         *  *  *  *  *  *
mZ         *  *  *  *  *  *
XX         *  *  *  *  *  *  # inertia about the frame origin [kg m^2]
XY         *  *  *  *  *  *
XZ         *  *  *  *  *  *
YY         *  *  *  *  *  *
YZ         *  *  *  *  *  *
ZZ         *  *  *  *  *  *

IA         *  *  *  *  *  *  # rotor inertia at the joint [kg m^2]
Fs         *  *  *  *  *  *  # Coulomb friction [N m]
Fv         *  *  *  *  *  *  # viscous friction [N m s/rad]
off        0  0  0  0  0  0  # torque offset [N m]

qmin       -360*deg  -360*deg  -360*deg  -360*deg  -360*deg  -360*deg  # [rad]
qmax        360*deg   360*deg   360*deg   360*deg   360*deg   360*deg
vmax        120*deg   120*deg   180*deg   180*deg   180*deg   180*deg  # [rad/s]
taumax          330       330       150        56        56        56  # [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
