# SPDX-License-Identifier: MIT
# The pictures of docs/explanation/proof.md, from what blind_score --figures wrote:
#   gnuplot -e "folder='FOLDER'; pictures='FOLDER'" proof.gnuplot
set datafile separator ","
set encoding utf8
blue = "#0072b2"; red = "#d55e00"; grey = "#777777"
set grid linecolor rgb "#dddddd"
set tics nomirror
set border 3
has(name) = int(system(sprintf("test -f %s/%s && echo 1 || echo 0", folder, name)))
table(name) = sprintf("%s/%s", folder, name)
picture(name) = sprintf("%s/%s.svg", pictures, name)

# found and named, against the strength that is left after the refit
if (has("detection.csv")) {
  set terminal svg size 760,470 font "sans,13" background rgb "white"
  set output picture("detection")
  set logscale x
  set xrange [4:450]
  set yrange [0:100]
  set xtics (5, 10, 20, 40, 80, 160, 300)
  set xlabel "lambda: chi-square that a refit of the model leaves"
  set ylabel "share of the cases, %"
  set key outside top center vertical maxrows 3 Left reverse samplen 2.5
  plot table("oracle.csv") using "lambda":(100 * column("one")) with lines linewidth 2 linecolor rgb grey title "oracle, 1 parameter", \
    "" using "lambda":(100 * column("asked")) with lines linewidth 2 dashtype 3 linecolor rgb grey title "oracle at the level of a diagnosis", \
    "" using "lambda":(100 * column("four")) with lines linewidth 2 dashtype 2 linecolor rgb grey title "oracle, 4 parameters", \
    table("detection.csv") using (column("lambda") / 1.02):(100 * column("found")):(100 * column("found_low")):(100 * column("found_high")) with yerrorbars pointtype 7 pointsize 0.8 linewidth 1.5 linecolor rgb blue title "found", \
    "" using (column("lambda") / 1.02):(100 * column("found")) with lines linecolor rgb blue notitle, \
    "" using (column("lambda") * 1.02):(100 * column("first")):(100 * column("first_low")):(100 * column("first_high")) with yerrorbars pointtype 9 pointsize 0.8 linewidth 1.5 linecolor rgb red title "family named first", \
    "" using (column("lambda") * 1.02):(100 * column("first")) with lines linecolor rgb red notitle
  unset logscale x
  set xtics autofreq
  set autoscale
}

# held-out error over that of the oracle
if (has("heldout.csv")) {
  set terminal svg size 760,400 font "sans,13" background rgb "white"
  set output picture("heldout")
  set logscale x
  set yrange [0:100]
  set xrange [*:*] noextend
  set xtics (0.9, 1, 1.1, 1.2, 1.3, 1.5, 2, 3, 5, 10)
  set xlabel "held-out rms over that of the oracle"
  set ylabel "share of the cases, %"
  set key bottom right Left reverse samplen 2.5
  set arrow 1 from 1, 0 to 1, 100 nohead dashtype 2 linecolor rgb grey
  plot table("heldout.csv") using "before":(100 * column("share")) with steps linewidth 2 linecolor rgb red title "model alone, refitted", \
    "" using "after":(100 * column("share")) with steps linewidth 2 linecolor rgb blue title "with the findings"
  unset arrow 1
  unset logscale x
  set xtics autofreq
  set autoscale
}

# which part of an effect the refit absorbs
if (has("concealed.csv")) {
  set terminal svg size 860,380 font "sans,13" background rgb "white"
  set output picture("concealed")
  set key off
  set multiplot layout 1,2
  set xlabel "chi-square that the refit absorbs, %"
  set ylabel "cases"
  set xrange [0:100]
  set yrange [0:*]
  set boxwidth 9
  set style fill solid 0.7 noborder
  bin(x) = 10 * (x >= 1 ? 9 : floor(10 * x)) + 5
  plot table("concealed.csv") using (bin(column("absorbed"))):(1) smooth frequency with boxes linecolor rgb blue
  set xlabel "residual rms above the noise, %"
  set ylabel "share of the cases, %"
  set autoscale x
  set logscale x
  set yrange [0:100]
  set xtics (0.01, 0.03, 0.1, 0.3, 1, 3, 10)
  stats table("concealed.csv") using "excess" nooutput
  plot table("concealed.csv") using (100 * column("excess")):(100.0 / STATS_records) smooth cumulative with steps linewidth 2 linecolor rgb blue
  unset multiplot
  unset logscale x
  set xtics autofreq
  set autoscale
}

# the truth, and the first answer
if (has("confusion.csv")) {
  rows = int(system(sprintf("wc -l < %s", table("confusion.csv")))) - 1
  columns = int(system(sprintf("head -1 %s | tr -cd , | wc -c", table("confusion.csv"))))
  set terminal svg size 240 + 26 * columns, 190 + 22 * rows font "sans,12" background rgb "white"
  set output picture("confusion")
  set key off
  unset grid
  unset colorbox
  unset xlabel
  unset ylabel
  set border 0
  set tics scale 0 noenhanced
  set palette defined (0 "#ffffff", 1 "#cfe3f2", 2 "#8fbfe0", 6 "#3a87bf", 12 "#0b4f86")
  set cbrange [0:12]
  set xrange [-0.5:columns - 0.5]
  set yrange [rows - 0.5:-0.5]
  set xtics rotate by 50 right
  set title "rows: what was left out; columns: the first answer" offset 0, -0.3
  plot table("confusion.csv") matrix rowheaders columnheaders using 1:2:3 with image pixels, \
    "" matrix rowheaders columnheaders using 1:2:($3 > 0 ? sprintf("%d", $3) : "") with labels
}
