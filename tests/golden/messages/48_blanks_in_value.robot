number_link 3
al pi / 2 0 0
th ( 1 + 2 ) 0 0
gz 9.81
stop
