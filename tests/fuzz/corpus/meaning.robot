number_link 3
sigma 0 3 x
ant 0 0 9
m -1 * 0
qmin 1 0 0 qmax 0 0 0
al 90 1.5708 0
stop
