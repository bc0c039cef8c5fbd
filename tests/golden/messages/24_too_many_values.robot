number_link 3
d 0 .5 0 0.25
th 0 0 0
gz 9.81
stop
