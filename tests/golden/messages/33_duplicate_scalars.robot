number_link 3
number_link 4
name a name b
gx 0 gx 1
gz 9.81
stop
