number_link 1
d 0 # ÿ
gz 9.81
stop
