number_link 3
d 0
  pi/2 0
th 0 0 0
gz 9.81
stop
