number_link 2
sigma 0 1
d 0 L
Fs 1 2
gz 9.81
effect stribek joint=1 Fs=2
effect stribeck joint=3 Fs=2
effect cogging joint=2 n=3
stop
