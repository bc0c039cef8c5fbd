number_link 3
d 0 1 0
th 0 0 0
D 0 2 0
gz 9.81
stop
