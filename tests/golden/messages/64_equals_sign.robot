number_link 3
let L = 0.5
let K=2
d = 0 L 0
r =0 0 0
gz 9.81
stop
