number_link 3
al sqrt sin*2 cos30
gz 9.81
stop
