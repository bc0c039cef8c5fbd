number_link 3
alpha 0 0 0
a 0 0 0
mass 1 1 1
// a comment
gz 9.81
stop
