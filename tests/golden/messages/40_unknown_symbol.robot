number_link 3
let L1 0.4
let L2 0.3
d L1 L3 L2
gz 9.81
stop
