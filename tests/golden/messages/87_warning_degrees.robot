number_link 3
al 90 -90 0
th 0 100*1.8 0
gz 9.81
stop
