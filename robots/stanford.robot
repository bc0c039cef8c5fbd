# SPDX-License-Identifier: MIT
# Stanford arm: two revolute joints, a prismatic one, a spherical wrist.
#
# Kinematics  the usual structure of the Stanford arm in modified frames, r1 = 0.412, r2 = 0.154
#             and r6 = 0.263 m (the textbooks' dimensions).
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        stanford
number_link 6
dh          modified
joints      waist shoulder boom wrist_roll wrist_pitch wrist_yaw

sigma          0      0     1  0      0      0  # 0 revolute, 1 prismatic
al             0  -pi/2  pi/2  0  -pi/2   pi/2  # alpha [rad]
d              0      0     0  0      0      0  # [m]
th             0      0     0  0      0      0  # added to q [rad]
r          0.412  0.154     0  0      0  0.263  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m                     8.4664             8.3406             2.3075             0.9419             7.7414             2.9808
mX               0.813367048       -1.171353864       -0.043819425       -0.116748505        1.865754814        -0.15932376
mY              -1.201890144       -0.066975018        0.246925575       -0.047650721       -0.372051684        0.436061232
mZ              -1.585672056       -0.558319764        0.374576475       -0.095970191        1.321379566        0.577589616
XX          0.55745984421048    0.3362187343967    0.1871635049675   0.08715405273638   0.63624608205358    0.2804979375216
XY          0.17056058613408  -0.00618797152792   0.01800911666925  -0.01737530686795   0.14372717636084    0.0628424728504
XZ          0.16402651441992  -0.15497242765616   0.00465120726025   0.00785849482555  -0.29536168920166   -0.0467468350248
YY           0.7029626916696   0.37415086166232    0.1657311300675   0.10153337995574   0.86517484584268   0.28851139486432
YZ         -0.21788700506976  -0.01680930770492  -0.06872142858975   0.01229386803731   0.10712050194196  -0.04611358492464
ZZ           0.5291384971436    0.4091797460547    0.0697846366615   0.04726262717014   0.73758437165518   0.21819125260128

# IA rotor inertia at the joint [kg m^2, kg]; Fs Coulomb friction [N m, N]; Fv viscous friction
# [N m s/rad, N s/m]; off torque offset [N m, N]
IA         0.41995  0.62652  0.67395  0.56462  0.98422  0.91544
Fs          1.4796    0.994   1.3713   0.2862   1.5302   0.4368
Fv          2.5597   1.2461    0.781   1.3541   0.8398   0.3835
off              0        0        0        0        0        0

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
