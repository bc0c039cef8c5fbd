number_link 3
joints a m r
gz 9.81
stop
