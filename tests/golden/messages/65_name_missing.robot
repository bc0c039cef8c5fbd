name number_link 3
name
gz 9.81
stop
