number_link 3
d 0 L 0
let L 0.5
r 0 L 0
gz 9.81
stop
