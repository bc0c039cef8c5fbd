number_link 3
al 1.5708 -1.571 3.1416
th 4.7124 0.0001 pi/2
gz 9.81
stop
