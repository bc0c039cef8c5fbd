number_link 3
let pi 3
let d 0.5
let 2x 1
let Sqrt 1
let
let L
r L 0 0
gz 9.81
stop
