number_link 3
let a b+1
let b a+1
d a b 0
gz 9.81
stop
