number_link 3
joints shoulder elbow
gz 9.81
stop
