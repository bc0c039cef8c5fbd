number_link
gz 9.81
stop
