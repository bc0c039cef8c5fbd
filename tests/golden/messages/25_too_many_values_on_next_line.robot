number_link 3
d 0 .5 0
  0.25 1
gz 9.81
stop
