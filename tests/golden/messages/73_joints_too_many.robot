number_link 3
joints a1 a2 a3 a4
gz 9.81
stop
