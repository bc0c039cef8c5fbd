number_link 3
let L 2
al atan2(1,2) 0 0
th tan(1) L(2) 0
gz 9.81
stop
