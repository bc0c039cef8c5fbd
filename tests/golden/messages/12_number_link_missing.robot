gz 9.81
stop
