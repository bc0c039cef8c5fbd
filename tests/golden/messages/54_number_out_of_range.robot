number_link 3
d 1e999 -1e-999 nan
r inf 1e300*1e300 1e-400
gz 9.81
stop
