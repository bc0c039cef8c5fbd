number_link 3
let L 1
let K 2
d K 0 0
gz 9.81
stop
