number_link 3
dh craig
gz 9.81
stop
