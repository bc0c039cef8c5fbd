number_link 3
this is the d of my robot
d 0 1 0
gz 9.81
stop
