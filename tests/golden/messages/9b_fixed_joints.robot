number_link 2
sigma 2 2
Fs 1 *
gz 9.81
effect stribeck joint=1 Fs=2
stop
