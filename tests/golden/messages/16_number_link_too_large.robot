number_link 200
gz 9.81
stop
