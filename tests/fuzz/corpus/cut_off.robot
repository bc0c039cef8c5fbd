number_link 1
d ((((1+2)*3-4)/5)^2
