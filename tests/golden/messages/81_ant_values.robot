number_link 3
ant 1 0.5 3
gz 9.81
stop
