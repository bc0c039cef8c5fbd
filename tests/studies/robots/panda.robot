# SPDX-License-Identifier: MIT
# The truth of the identification study: kinematics of robots/panda.robot, every parameter a number.
#
# Inertia     made up: masses, centres and tensors of the size of such links.
# Actuators   made up: rotor inertia, friction and offset of the size of such drives.

name        panda
number_link 7
dh          modified

sigma          0      0      0       0        0     0      0  # 0 revolute, 1 prismatic
al             0  -pi/2   pi/2    pi/2    -pi/2  pi/2   pi/2  # alpha [rad]
d              0      0      0  0.0825  -0.0825     0  0.088  # [m]
th             0      0      0       0        0     0      0  # added to q [rad]
r          0.333      0  0.316       0    0.384     0      0  # [m]

# kg; kg m; kg m^2 about the frame origin; then kg m^2, N m, N m s/rad, N m
m         4.97          3       3.23       3.59        1.9       1.67       1.24
mX     0.01938    -0.0093    0.08883     -0.191    -0.0228     0.1004    0.02542
mY     0.01044    -0.1461     0.1269     0.3748    0.07809   -0.02355  -0.005332
mZ     -0.2366     0.0405    -0.2148    0.09872     -0.149   -0.01754     0.1012
XX     0.05928    0.02266    0.05647    0.06774    0.05039   0.004516    0.02078
XY  -0.0003407  -0.001653  -0.008291    0.02774  -0.001163   0.001515 -0.0002907
XZ    0.002963   0.001126  -0.005493   0.003952  -0.005788 -0.0001461  -0.003274
YY     0.06334   0.009776    0.05293    0.03248    0.04145    0.01062    0.01878
YZ    0.008497   0.002672  -0.004359  -0.001707   0.006322  5.276e-05 -0.0002649
ZZ      0.0111    0.02314    0.02823    0.07759    0.01208    0.01176   0.005344
IA         0.6       0.55       0.45       0.45        0.2       0.18       0.15
Fs        0.75       0.85       0.55       0.65       0.45        0.3       0.28
Fv        0.35        0.4       0.28        0.3       0.22       0.15       0.12
off      -0.15        0.2       0.12       -0.1       0.08      -0.06       0.05

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
