number_link 3
d: 0 1 0
r [0 1 0]
th "0" 0 0
% a comment
al 0 90° π/2
off −1 0 0
XX 0 0 0
m 1 ‮2 3
gz 9.81
stop
