number_link 3
al 1+ 0 0
th /2 0 0
d 2*/3 0 0
r () 1 1
gz 9.81
stop
