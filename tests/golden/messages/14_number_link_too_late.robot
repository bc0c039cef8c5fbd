sigma 0 0 0
d 0 1 0
number_link 3
gz 9.81
stop
