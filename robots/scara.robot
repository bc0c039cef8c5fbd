# SPDX-License-Identifier: MIT
# SCARA arm: two vertical revolute axes, a prismatic one down (alpha3 = pi), and the tool's roll.
#
# Kinematics  made up, of the size of a small industrial SCARA.
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        scara
number_link 4
dh          modified
joints      shoulder elbow quill roll

sigma          0      0      1     0  # 0 revolute, 1 prismatic
al             0      0     pi     0  # alpha [rad]
d              0  0.325  0.275     0  # [m]
th             0      0      0     0  # added to q [rad]
r          0.387      0      0  0.05  # [m]

# m mass [kg]; mX mY mZ first moments about the frame origin [kg m]; XX to ZZ inertia about the
# frame origin [kg m^2]
m                    3.4705             9.6188            1.1794            5.3564
mX              -0.47837372       -0.916383076       -0.28199454        1.29276714
mY               -0.5518095        -1.86700908      -0.289813962       -0.85354234
mZ              0.625002345       -1.186767544       0.069667158      -1.001753928
XX         0.42226238281105   0.77120984200672  0.08500522390532  0.56295699149356
XY           -0.12092542148   -0.1801599550516  -0.0678675183142    0.310519443759
XZ          0.0689893232348  -0.08843834391688   0.0181904174778   0.3137313105228
YY         0.36819770587585   0.42552319522924  0.09853313353706  0.75001136885356
YZ           0.028037372855   -0.1236355802904  0.01861831073534  -0.2157824884268
ZZ          0.3676567440648   0.55939927807852  0.16432987939626    0.699007321118

IA         0.02515  0.85562  0.17277  0.98733  # rotor inertia at the joint [kg m^2, kg]
Fs          0.4961   0.7182   1.4206   1.5828  # Coulomb friction [N m, N]
Fv          0.5335   2.1863   2.7267    0.282  # viscous friction [N m s/rad, N s/m]
off              0        0        0        0  # torque offset [N m, N]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 0
gz 9.81

stop
