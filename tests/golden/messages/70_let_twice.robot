number_link 3
let L 1
let L 2
d L L 0
gz 9.81
stop
