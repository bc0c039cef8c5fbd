number_link 3
name m
gz 9.81
stop
