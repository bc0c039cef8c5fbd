number_link 1
d 9^9^9
r 1/0
th sqrt(-1)
al 0^0
stop
