number_link 3
th 6.68 13 7.5
qmin -170 -3 0
qmax 170 3 100*pi
gz 9.81
stop
