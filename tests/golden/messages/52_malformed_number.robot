number_link 3
d 1.2.3 1e 1e+
r 0x10 .e5 .
gz 9.81
stop
