number_link 3
m 1 -2 3
IA 0 0 -1e-9
gz 9.81
stop
