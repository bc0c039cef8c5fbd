number_link 3
sigma 0 3 -1
gz 9.81
stop
