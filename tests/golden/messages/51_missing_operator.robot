number_link 3
th 90deg 2pi (1)(2)
gz 9.81
stop
