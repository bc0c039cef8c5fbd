# SPDX-License-Identifier: MIT
# Planar arm of the study of the diagnosis: robots/planar2r.robot with offsets.
#
# Kinematics  made up: the first link is 0.5 m long.
# Inertia     made up for testing; likewise IA, Fs, Fv and off.

name        planar2
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
off            0.4     -0.2  # torque offset [N m]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 9.81
gz 0

stop
