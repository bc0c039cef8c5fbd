# SPDX-License-Identifier: MIT
# Angles that are no nice fractions, and zeros in odd places: a robot on which GiNaC's order of terms once
# showed in the output.
name odd_angles
NUMBER_LINK 11
let L 0.37
Mx 0 0 0 0 0 0 0 0 -0.2 2.0 0
sigma 1 0 1 0 0 1 0 0 1 1 0
MZ 0 0 0 0 0 0 0 0 0 0 1.0
Yz 0 0 0 0 0 0 0 0 0 -1.265 0
My 0 0 0 -0.753 -0.869 1.536388 0.362893 -1.845 1.998627 -0.905331 0.474631
R 0 0 0 0 0 0 0 0 0 0 L
Al 0 0 0.3 0 2*pi/3+0.1 0 0 0 pi/3 0 0
th 0 0 0 0 0 -pi/2 0 0 0 0 0
xx 0 0 0.995 -1.0 0 1.1 0 0 0 0 0
