number_link 3
# comments may hold anything: ÿþ
d 0 0.5° 0
gz 9.81
stop
