number_link 2
parameters
sigma 0 0
parameters base bodies
m 1 2
gz 9.81
stop
