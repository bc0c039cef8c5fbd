number_link 3
effect stribeck joint=2 Fs = 2 vs=0.05
effect cable k= joint=1
effect backlash joint=1 joint=2
effect
effect ripple vs = 3
 joint=3
effect load k=foo 2
gz 9.81
stop
