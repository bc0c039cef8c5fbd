number_link 3
Fs 1 -.5 1
Fv 0 0 -0.214025
gz 9.81
stop
