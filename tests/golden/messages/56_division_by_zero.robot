number_link 3
let s sin(1)
d 1/0 1/(s^2+cos(1)^2-1) 0^-1
r 0^0 1/sin(pi) 0
gz 9.81
stop
