number_link 1
let a b
let b a
d a
gz 9.81
stop
d 0
