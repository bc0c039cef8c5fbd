# SPDX-License-Identifier: MIT
# PUMA 560 in STANDARD (distal) frames: Corke's Robotics Toolbox, mdl_puma560.
#
# Kinematics  mdl_puma560; joint i turns about z(i-1), d is Corke's a and r is his d.
# Inertia     mdl_puma560, moved exactly to the origins of the distal frames.
# IA          Jm G^2.
# Friction    Fv = B G^2 and Fs = |G| (|Tc+| + |Tc-|) / 2, the mean of his two directions.

name        puma560_corke_std
number_link 6
dh          standard
joints      waist shoulder elbow wrist_roll wrist_pitch wrist_yaw

sigma         0       0        0       0      0  0  # 0 revolute, 1 prismatic
al         pi/2       0    -pi/2    pi/2  -pi/2  0  # alpha [rad]
d             0  0.4318   0.0203       0      0  0  # [m]
th            0       0        0       0      0  0  # added to q [rad]
r             0       0  0.15005  0.4318      0  0  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m             0         17.4           4.8        0.82    0.34        0.09
mX            0     -6.33012      -0.09744           0       0           0
mY            0       0.1044      -0.06768     0.01558       0           0
mZ            0       3.9585         0.336           0       0     0.00288
XX            0   1.03118515   0.090474288  0.00209602  0.0003  0.00024216
XY            0   0.03798072  -0.001373904           0       0           0
XZ            0    1.4401023     0.0068208           0       0           0
YY         0.35  3.727456406   0.111498032      0.0013  0.0004  0.00024216
YZ            0    -0.023751     0.0047376           0       0           0
ZZ            0  2.842524056    0.01543232  0.00209602  0.0003     0.00004

# IA rotor inertia at the joint [kg m^2]; Fs Coulomb friction [N m]; Fv viscous friction [N m
# s/rad]; off torque offset [N m]
IA          0.784029968642     2.324814845   0.576873331938   0.19079062612368   0.170706291657   0.194064505668
Fs              25.9836065      10.6197775       6.36419655         1.06831142       0.85444524       0.55443978
Fv         5.8018217679508  9.496868641825  3.9804259903722  0.411645229697152  0.4272830209354  0.2158232532732
off                      0               0                0                  0                0                0

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
