# SPDX-License-Identifier: MIT
# Staubli RX-90, six revolute joints.
#
# Kinematics  modified frames in the manner of Khalil and Dombre, "Modeling, Identification and
#             Control of Robots", 2002, with d3 = r4 = 0.45 m.
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        rx90
number_link 6
dh          modified

sigma      0     0     0      0     0      0  # 0 revolute, 1 prismatic
al         0  pi/2     0  -pi/2  pi/2  -pi/2  # alpha [rad]
d          0     0  0.45      0     0      0  # [m]
th         0     0     0      0     0      0  # added to q [rad]
r          0     0     0   0.45     0      0  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m                    6.5629             3.0153            7.3771           2.974            0.8015             7.4994
mX              1.612701417       -0.263145231       -0.45369165       0.0841642       0.155098265       -1.829553624
mY             -1.323343156        0.021589548      -0.453986734      -0.4957658       -0.00477694       -0.905777532
mZ              0.021985715       -0.066517518       0.512487137       0.1393319       -0.03007228       -0.845482356
XX         0.74107356612109   0.09914395761076  0.31741482501775  0.150401858375    0.030135782508    0.5202244911304
XY         0.26054411372388  -0.05043088014604   -0.025717184141   0.01111217214   0.0061263856594  -0.40489348670672
XZ         0.10690845025305  -0.04955198379586   0.1556939589255   0.00716090723   0.0015522869028  -0.27496887556976
YY         0.77175877134466   0.17560806075645  0.42495251788239  0.213090546375  0.04773937720575   0.81810058292648
YZ          0.0993041995726  -0.02493673457112  0.02352445841098   0.00597162773  -0.0066792307888  -0.21111535895768
ZZ         0.86304803317525   0.19916626547305  0.16905538008536   0.24995500572  0.05629753582255     0.947743712426

# IA rotor inertia at the joint [kg m^2]; Fs Coulomb friction [N m]; Fv viscous friction [N m
# s/rad]; off torque offset [N m]
IA         0.27102  0.77343  0.20456  0.02513  0.9915  0.95435
Fs          1.8866    0.667   1.7787   0.7431  1.9883   0.1613
Fv          2.2188   2.6841   2.4224   0.7709  0.2996   2.9059
off              0        0        0        0       0        0

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
