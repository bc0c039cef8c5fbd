number_link 3
d 0 0.5 0
gz 9.81
