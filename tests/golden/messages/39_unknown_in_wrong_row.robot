number_link 3
sigma 0 * 0
al * 0 0
th 0 0 *
ant 0 * 2
qmin * 0 0
d * 0 *
gz 9.81
stop
