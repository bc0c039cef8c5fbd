# SPDX-License-Identifier: MIT
# The planar arm with effects that do not remember.
#
# Kinematics  made up: the first link is 0.5 m long.
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        algebraic_arm
number_link 2
dh          modified

sigma      0    0  # 0 revolute, 1 prismatic
al         0    0  # alpha [rad]
d          0  0.5  # [m]
th         0    0  # added to q [rad]
r          0    0  # [m]

m                    9.4636            0.7927  # mass [kg]
mX             -0.665196444        0.15647898  # first moments about the frame origin [kg m]
mY               1.34761664       0.029187214
mZ              0.431918704      -0.043479595
XX         0.60668037918656  0.01889752900523  # inertia about the frame origin [kg m^2]
XY          0.0276319736256  -0.0023455560436
XZ         0.16348456570416    0.009242872053
YY         0.52556942769932  0.06646880643775
YZ          0.0213277765504   0.0072139186879
ZZ         0.55884926758476  0.05774062387148

IA         0.67065  0.47588  # rotor inertia at the joint [kg m^2]
Fs           2.911   2.5288  # Coulomb friction [N m]
Fv          0.7729   1.7243  # viscous friction [N m s/rad]
off              0        0  # torque offset [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 9.81
gz 0

effect stribeck joint=2 Fs=3.1 vs=0.05
effect load_friction joint=2 mu=0.05
effect cogging joint=1 a=0.3 b=0.2 n=24
effect power_law_viscous joint=1 Fa=0.8 alpha=0.7
effect tanh_viscous joint=2 A=0.4 vt=0.3
effect motor_coupling joint=2 other=1 F=0.3 Fvm=0.1 I=0.02 ratio=0.5
effect gas_spring joint=2 F0=500 n=1.3

stop
