# SPDX-License-Identifier: MIT
# Step responses of the Sarcos arm, with and without gravity compensation, as a picture:
#   gnuplot -e "folder='FOLDER'; picture='FILE.svg'" sarcos_steps.gnuplot
set terminal svg dynamic size 960,560 font "sans,11" background rgb "white"
set output picture
set datafile separator ","
set grid linecolor rgb "#dddddd"
set tics nomirror
set border 3
set key bottom right
set xlabel "time, s"
set multiplot layout 2,2 title "Steps of 0.2 rad with the gravity that was identified, and without"
do for [j = 1:4] {
  set title sprintf("joint %d", j)
  set ylabel "position, rad"
  file(c) = sprintf("%s/joint%d_%s.csv", folder, j, c)
  demand = sprintf("%s/demand%d.csv", folder, j)
  plot demand using "time":(column(1 + j)) with lines dashtype 3 linecolor rgb "#777777" title "goal", \
    file("gravity") every 10 using "time":(column(1 + j)) with lines linewidth 2 linecolor rgb "#0072b2" title "compensated", \
    file("pd") every 10 using "time":(column(1 + j)) with lines linewidth 2 linecolor rgb "#d55e00" title "PD alone"
}
unset multiplot
