number_link 3
vmax 1 0 2
amax -1 1 1
taumax 0 0 1
gz 9.81
stop
