number_link 3
thh 0 0 0
sgima 0 0 0
colour 1 2 3
gz 9.81
stop
