# SPDX-License-Identifier: MIT
# The truth of the identification study: kinematics of robots/ur10e.robot, every parameter a number.
#
# Inertia     made up: masses and lengths of the robot's size, links as slightly skewed rods.
# Actuators   made up: rotor inertia, friction and offset of the size of such drives.

name        ur10e
number_link 6
dh          modified
joints      shoulder_pan shoulder_lift elbow wrist_1 wrist_2 wrist_3

sigma           0     0        0         0        0        0  # 0 revolute, 1 prismatic
al              0  pi/2        0         0     pi/2    -pi/2  # alpha [rad]
d               0     0  -0.6127  -0.57155        0        0  # [m]
th              0     0        0         0        0        0  # added to q [rad]
r          0.1807     0        0   0.17415  0.11985  0.11655  # [m]

# kg; kg m; kg m^2 about the frame origin; then kg m^2, N m, N m s/rad, N m
m        7.369      13.05      3.989        2.1       1.98      0.615
mX     0.02948     -3.037     -1.323     0.0042   -0.00594    0.00246
mY     -0.2358    0.07831   -0.01596    -0.0378    0.03564   -0.00369
mZ    -0.05895      2.062     0.2713     0.0294    0.02376   -0.01599
XX      0.0481     0.3582    0.02454   0.005835   0.005398  0.0008684
XY    0.001745    0.02764  -0.007907  0.0002179  1.749e-05  2.767e-05
XZ  -0.0003254     0.4732    0.09178 -0.0001584  0.0001339  5.492e-05
YY     0.04067       1.66     0.5879   0.005163   0.004774  0.0008561
YZ   -0.001513   -0.01194  0.0009764  0.0006001 -0.0004722 -8.266e-05
ZZ     0.02839      1.335     0.5695   0.003314   0.003134   0.000524
IA         2.1        2.1          1       0.35       0.35        0.3
Fs         9.5        8.7        6.4        2.3        2.1        1.8
Fv          12         11        7.5        2.2          2        1.7
off        0.6       -0.9        0.4      -0.15        0.2        0.1

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
