# SPDX-License-Identifier: MIT
# KUKA LBR iiwa 14 R820, seven joints.
#
# Kinematics  dimensions of KUKA's data sheet (base to shoulder 0.36, shoulder to elbow 0.42,
#             elbow to wrist 0.4, wrist to flange 0.126 m). The arm is upright at q = 0; axes 2, 4
#             and 6 then point along +y, -y and +y of the base, as KUKA's do. Frame 7 is at the
#             flange.
# Limits      KUKA's data sheet: axis range, speed at rated payload, and joint torques.
# Inertia     unknown ('*'), likewise IA, Fs and Fv: to be identified from recordings.

name        kuka_iiwa14
number_link 7
dh          modified
joints      A1 A2 A3 A4 A5 A6 A7

sigma         0      0     0     0      0      0      0  # 0 revolute, 1 prismatic
al            0  -pi/2  pi/2  pi/2  -pi/2  -pi/2   pi/2  # alpha [rad]
d             0      0     0     0      0      0      0  # [m]
th            0      0     0     0      0      0      0  # added to q [rad]
r          0.36      0  0.42     0    0.4      0  0.126  # [m]

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

qmin       -170*deg  -120*deg  -170*deg  -120*deg  -170*deg  -120*deg  -175*deg  # [rad]
qmax        170*deg   120*deg   170*deg   120*deg   170*deg   120*deg   175*deg
vmax         85*deg    85*deg   100*deg    75*deg   130*deg   135*deg   135*deg  # [rad/s]
taumax          320       320       176       176       110        40        40  # [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
