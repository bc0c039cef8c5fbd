number_link 3
d PI/2 foo 0
gz 9.81
stop
