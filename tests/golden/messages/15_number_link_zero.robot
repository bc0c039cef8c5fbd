number_link 0
gz 9.81
stop
