# SPDX-License-Identifier: MIT
# Arm with a revolute joint about a horizontal axis and a prismatic joint across it; gravity is
# along -y0.
#
# Kinematics  made up; the simplest robot with a prismatic joint.
# Inertia     inertial values are made up for testing; likewise IA, Fs and Fv.

name        rp
number_link 2
dh          modified

sigma      0     1  # 0 revolute, 1 prismatic
al         0  pi/2  # alpha [rad]
d          0     0  # [m]
th         0     0  # added to q [rad]
r          0     0  # [m]

m                     2.0199             5.6267  # mass [kg]
mX               0.086795103        1.193591871  # first moments about the frame origin [kg m]
mY               0.327062208        1.390807706
mZ              -0.204757263        1.187908904
XX          0.27315715646967   0.94003717658156  # inertia about the frame origin [kg m^2]
XY          0.01792113692224  -0.24692503867378
XZ          0.03922041959111  -0.31736711580552
YY          0.11323682932622   0.89015397140771
YZ         -0.02418070397504  -0.27521732289072
ZZ          0.19612249829527   0.79802249236431

IA         0.13535  0.12254  # rotor inertia at the joint [kg m^2, kg]
Fs          1.5972   1.5073  # Coulomb friction [N m, N]
Fv          1.6381   2.9324  # viscous friction [N m s/rad, N s/m]
off              0        0  # torque offset [N m, N]

# base acceleration -g in frame 0 [m/s^2]
gx 0
gy 9.81
gz 0

stop
