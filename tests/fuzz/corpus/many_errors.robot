d 0 0
number_link x
foo 1 2
name 3
dh q
joints a a
let d 1
effect e k k=1
d −1
