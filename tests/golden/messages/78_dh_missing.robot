number_link 3
dh
d 0 0 0
gz 9.81
stop
