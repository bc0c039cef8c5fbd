number_link 2
sigma 0 0
parameters identified
al 0 0
m 1 2
gz 9.81
stop
