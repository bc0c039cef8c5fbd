number_link 3
sigma 0 0 0 dd 0 1 0 m 1 2
gz 9.81
stop
