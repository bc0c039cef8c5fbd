number_link 3
name arm
0 1 0
gz 9.81
stop
