# SPDX-License-Identifier: MIT
# UR10e with numbers for every parameter, to compare with stored torques.
#
# Kinematics  as in robots/ur10e.robot.
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        ur10e_oracle
number_link 6
dh          modified

sigma           0     0        0         0        0        0  # 0 revolute, 1 prismatic
al              0  pi/2        0         0     pi/2    -pi/2  # alpha [rad]
d               0     0  -0.6127  -0.57155        0        0  # [m]
th              0     0        0         0        0        0  # added to q [rad]
r          0.1807     0        0   0.17415  0.11985  0.11655  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m                     9.8329            1.9369             7.1256             3.0635             2.8932             5.2227
mX               -2.25960042       -0.19833856       -0.264502272        0.060075235        0.533766468        1.125961893
mY              -1.854583269       -0.43405929        1.374100704        0.280769775        0.709875552        0.759955077
mZ              -0.175713923       0.206337957        -1.27940148         0.40027691        -0.55419246         1.29731868
XX           0.8269789581701  0.14494986944821   1.13591311549336   0.18340473093935   0.30235963115172   0.60125802336627
XY          -0.3497412352162   -0.048163671296  -0.07838138186752  -0.00343089528775  -0.13823594058848  -0.13936871505043
XZ           0.0522289404946   0.0238150067968    0.0264306170624    0.0017485697949    0.1039629669454   -0.2038539342212
YY          0.83939418432001  0.05222705110321   0.53346986007064   0.16915325641895   0.29289714139432   0.82659908462387
YZ         -0.00453640301703   0.0560183361637    0.5198417814032   -0.0424663788015    0.1323766619856   -0.2494408411268
ZZ          1.17752512688209    0.136634555433     0.796466904096    0.1140066252371   0.37018664112004   0.62403218776614

# IA rotor inertia at the joint [kg m^2]; Fs Coulomb friction [N m]; Fv viscous friction [N m
# s/rad]; off torque offset [N m]
IA         0.96657  0.52911  0.61663  0.97972  0.53189  0.24346
Fs          1.2539    0.511   0.9656   1.5506   2.7242   0.8458
Fv          2.5318   2.2316   0.1298   1.6794   1.8749   0.3952
off              0        0        0        0        0        0

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
