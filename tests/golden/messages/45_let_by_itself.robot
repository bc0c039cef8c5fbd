number_link 3
let a a+1
d a 0 0
gz 9.81
stop
