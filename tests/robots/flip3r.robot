# SPDX-License-Identifier: MIT
# Parallel axes of which the last is turned over: its angle counts backwards in the chain.
name flip3r
number_link 3
al 0 0 pi
d 0 0.5 0.4
m 1 1 1
mX 0.1 0.1 0.1
ZZ 1 1 1
gy 9.81
stop
