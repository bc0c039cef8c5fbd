number_link 5/2
gz 9.81
stop
