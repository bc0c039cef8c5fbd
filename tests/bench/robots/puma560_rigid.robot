# SPDX-License-Identifier: MIT
# PUMA 560 as rigid bodies: ten inertial parameters of every link, none of them zero; no drives.
#
# Kinematics  as in robots/puma560.robot.
# Inertia     made up near the arm's own values, positive about every centre of mass.

name        puma560_rigid
number_link 6
dh          modified

sigma      0       0        0        0      0     0  # 0 revolute, 1 prismatic
al         0   -pi/2        0     pi/2  -pi/2  pi/2  # alpha [rad]
d          0       0   0.4318  -0.0203      0     0  # [m]
th         0       0        0        0      0     0  # added to q [rad]
r          0  0.2435  -0.0934   0.4331      0     0  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m           13.1       17.4         4.8         0.82         0.34         0.09
mX        0.1572     1.1832     -0.0192      0.00246     -0.00068      0.00009
mY       -2.3973     0.1044      -0.336     -0.00164      0.00136     -0.00027
mZ       -0.7074    -0.2784      0.0672     -0.01558      0.00102      0.00288
XX     1.0969055  0.1350808   0.0904608    0.0020993    0.0003085   0.00024297
XY     0.0455676  0.0020008   -0.000469   0.00009592   0.00002372   0.00000627
XZ    -0.0035112  0.0124312  -0.0003562  -0.00001826  -0.00001296  -0.00000688
YY      0.280086   0.608912   0.0135176    0.0020034   0.00041442   0.00025225
YZ    -0.1078542  0.0133704    0.005829   0.00008584   0.00002292   0.00001664
ZZ     1.0205923   0.620084   0.0945968   0.00131066    0.0003668    0.0000909

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
