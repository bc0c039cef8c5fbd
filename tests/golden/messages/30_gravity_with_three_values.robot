number_link 3
gx 0 0 9.81
gz 9.81
stop
