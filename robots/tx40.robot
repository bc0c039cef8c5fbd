# SPDX-License-Identifier: MIT
# Staubli TX40, six joints.
#
# Kinematics  modified frames and dimensions used with the TX40 recordings of figaroh-plus (CNRS,
#             Toward; Apache-2.0). Arm 0.225, forearm 0.225, shoulder offset 0.035, base height
#             0.32 m. Joint angles are those of these frames: q2 and q3 are the robot's minus and
#             plus pi/2.
# Inertia     unknown ('*'), likewise IA, Fs and Fv: to be identified from recordings.

name        tx40
number_link 6
dh          modified

sigma         0      0      0      0      0     0  # 0 revolute, 1 prismatic
al            0  -pi/2      0   pi/2  -pi/2  pi/2  # alpha [rad]
d             0      0  0.225      0      0     0  # [m]
th            0      0      0      0      0    pi  # added to q [rad]
r          0.32      0  0.035  0.225      0     0  # [m]

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

# the wrist's gears couple joints 5 and 6: a matter of the effect joint_coupling, not of a row here
IA         *  *  *  *  *  *  # rotor inertia at the joint [kg m^2]
Fs         *  *  *  *  *  *  # Coulomb friction [N m]
Fv         *  *  *  *  *  *  # viscous friction [N m s/rad]
off        *  *  *  *  *  *  # torque offset [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
