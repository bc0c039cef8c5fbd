number_link 2 d 1,2 r 3
 4 th 0 0 gz 9.81 stop