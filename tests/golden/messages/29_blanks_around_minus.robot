number_link 3
let L 2
d L - 0.1 0 0
gz 9.81
stop
