number_link 2
let a pi/4+sqrt(2)
let b sin(a)^2-cos(a)/3e-2
al a -b*(a+b)
d 1e-3 2^-.5
gz 9.81
stop
