number_link 3
d 2**3 0 0
gz 9.81
stop
