number’link 3
gz 9.81
stop
