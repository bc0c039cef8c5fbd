number_link 3
d 0 1 0
stop
