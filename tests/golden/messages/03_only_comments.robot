# a robot
; soon
