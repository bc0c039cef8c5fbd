number_link 3
qmin -1 0 2*pi
qmax 1 -1 pi
gz 9.81
stop
