number_link 3
th sin(1e9) 0 0
gz 9.81
stop
