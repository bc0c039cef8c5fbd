# SPDX-License-Identifier: MIT
# PUMA 560, all six joints.
#
# Kinematics  modified frames of Armstrong, Khatib and Burdick, "The explicit dynamic model and
#             inertial parameters of the PUMA 560 arm", 1986.
# Inertia     links: same paper (tables 4 to 6), with the numbers of Corke's Robotics Toolbox.
#             They are moved exactly to the frame origins. Link 3 has Izz = 0.086 about its
#             centre of mass. The mass of link 1 has no effect and is 0.
# IA          motor and drive inertia at the joint, same paper, table 6.
# Friction    Corke's Robotics Toolbox, mdl_puma560, moved from motor to joint: Fv = B G^2 and Fs
#             = |G| (|Tc+| + |Tc-|) / 2. Fs is the mean of both directions, in which his Coulomb
#             friction differs.

name        puma560
number_link 6
dh          modified
joints      waist shoulder elbow wrist_roll wrist_pitch wrist_yaw

sigma      0       0        0        0      0     0  # 0 revolute, 1 prismatic
al         0   -pi/2        0     pi/2  -pi/2  pi/2  # alpha [rad]
d          0       0   0.4318  -0.0203      0     0  # [m]
th         0       0        0        0      0     0  # added to q [rad]
r          0  0.2435  -0.0934   0.4331      0     0  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m             0        17.4        4.8        0.82    0.34        0.09
mX            0      1.1832          0           0       0           0
mY            0      0.1044     -0.336           0       0           0
mZ            0     -0.2784     0.0672    -0.01558       0     0.00288
XX            0   0.1350808  0.0904608  0.00209602  0.0003  0.00024216
XY            0  -0.0070992          0           0       0           0
XZ            0   0.0189312          0           0       0           0
YY            0    0.608912  0.0134408  0.00209602  0.0003  0.00024216
YZ            0   0.0016704   0.004704           0       0           0
ZZ         0.35    0.620084    0.10952      0.0013  0.0004     0.00004

# IA rotor inertia at the joint [kg m^2]; Fs Coulomb friction [N m]; Fv viscous friction [N m
# s/rad]; off torque offset [N m]
IA                    1.14            4.71            0.827                0.2            0.179            0.193
Fs              25.9836065      10.6197775       6.36419655         1.06831142       0.85444524       0.55443978
Fv         5.8018217679508  9.496868641825  3.9804259903722  0.411645229697152  0.4272830209354  0.2158232532732
off                      0               0                0                  0                0                0

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
