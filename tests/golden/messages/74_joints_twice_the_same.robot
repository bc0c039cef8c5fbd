number_link 3
joints arm elbow arm
gz 9.81
stop
