number_link 3
d 0 0.5 0
gz 9.81
m 1 2