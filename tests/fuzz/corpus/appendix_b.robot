; The form of the thesis's Appendix B: no dh, no name, rows that share a line or run on over
; line ends. Its reader took the constants of standard (distal) frames; here, where no dh row
; stands, frames are modified: this file tests the form and not that robot's torques.
; Values as far as the print is legible; ZZ2 is not.
number'link 3
SIGMA 0 0 0 R 0 .149 0
AL pi/2 0 -pi/2  TH 0 0 0
D 0 .432 .02
M 0 0 0
XX 0 0 -.1939918 XY 0 .27590585 0
XZ 0 0 -.01917035
YY 0.023046964 0
   0
YZ 0 -.013731773 .01250796 ZZ 0 * 0
MX 0 -.03555448 0 MY 0
   .03011657 0
MZ 0 0 .01999423
IA 0 0 0
FS .115261 +.068686146 .09904939
FV .14674 -.214025 .0926147
GX 0 GY 0 GZ 9.81
stop
