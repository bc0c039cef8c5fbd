number_link 3
d sqrt(1-2) (-8)^(1/3) sqrt(-pi)
gz 9.81
stop
