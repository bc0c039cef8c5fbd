# SPDX-License-Identifier: MIT
# A Sarcos GRLA that moves: robots/sarcos_grla.robot with inertia and damping.
#
# Kinematics and gravity parameters (first moments, no masses, base acceleration) are those of that
# file, so that both need the same torque to stand. The thesis identifies nothing else; inertia and
# damping are guesses: the upper arm's first moment of 78 kg m along z2 at 0.6 to 0.7 m is about 50
# kg m^2, the forearm's 23 kg m along z4 at 0.5 m about 12 kg m^2; the mass matrix is positive
# definite in all postures that were tried (tests/studies/sarcos_test.cpp). A hydraulic arm has no
# gears, hence no rotor inertia; Coulomb friction is left out, so that steps end where gravity and
# stiffness balance.

name        sarcos_plant
number_link 7
dh          standard

sigma         0     0       0     0      0     0   0  # 0 revolute, 1 prismatic
al         pi/2  pi/2   -pi/2  pi/2  -pi/2  pi/2  pi  # alpha [rad]
d             0     0       0     0      0     0   0  # [m]
th            0     0       0     0      0     0   0  # added to q [rad]
r             0     0  0.8788     0  0.762     0   0  # [m]

m               0        0        0        0       0        0        0
mX         3.7467   5.3212  -2.5465   0.4624  0.2526  -0.1174  -1.7239
mY              0        0        0        0       0        0  -0.3668
mZ         3.7196  78.0962   3.9049  23.1605  0.6161  -0.0052        0
XX              3       50        3       12     0.5      0.2      0.2
XY              0        0        0        0       0        0        0
XZ              0        0        0        0       0        0        0
YY              3       50        3       12     0.5      0.2      0.6
YZ              0        0        0        0       0        0        0
ZZ              4        2        2      0.6     0.4      0.2      0.7

Fv             20       20       10       10       2        1        1

gx 0
gy -6.93567
gz 6.93567

stop
