number_link 3
d 0 .5
th 0 0 0
gz 9.81
stop
