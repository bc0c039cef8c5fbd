number_link 3
let upper_arm 0.4
d uper_arm upper_arm 0
gz 9.81
stop
