name my robot
number_link 3
gz 9.81
stop
