number_link 3
gz 9.81
stop # fine
# fine
d 0 0 0
