number_link 3
d 0,5 1,25 0
gz 9.81
stop
