#!/bin/sh
# SPDX-License-Identifier: MIT
# Step responses of joints 1 to 4 of the Sarcos arm with and without gravity compensation, as in
# Figures 7.13 and 7.14 of the thesis "Dynamic estimation for serial manipulators" (1995).
#
#   sarcos_steps.sh DYNID FOLDER
#
# Writes FOLDER/joint<j>_<controller>.csv: time, q1..q7, tau, qd, qdd of a step of 0.2 rad at joint j
# alone, from rest. The controller's model is the identified gravity, robots/sarcos_grla.robot.
# With gnuplot present FOLDER/sarcos_steps.svg shows them.
set -eu
if [ $# -ne 2 ]; then
  echo "usage: sarcos_steps.sh DYNID FOLDER" >&2
  exit 2
fi
dynid=$1
folder=$2
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$folder"
start=0,0.5,0,0.8,0,0,0
for joint in 1 2 3 4; do
  case $joint in
    1) goal=0.2,0.5,0,0.8,0,0,0 ;;
    2) goal=0,0.7,0,0.8,0,0,0 ;;
    3) goal=0,0.5,0.2,0.8,0,0,0 ;;
    4) goal=0,0.5,0,1.0,0,0,0 ;;
  esac
  awk -v goal="$goal" 'BEGIN {
    print "time,q1,q2,q3,q4,q5,q6,q7"
    for (k = 0; k <= 30; ++k) printf "%.1f,%s\n", k / 10, goal
  }' > "$folder/demand$joint.csv"
  for controller in pd gravity; do
    "$dynid" simulate "$root/robots/sarcos_grla.robot" \
      --plant "$root/tests/studies/robots/sarcos_plant.robot" \
      --trajectory "$folder/demand$joint.csv" --start $start --duration 3 \
      --controller $controller --bandwidth 2 --damping 1 \
      -o "$folder/measured.csv" --truth "$folder/joint${joint}_$controller.csv" > "$folder/joint${joint}_$controller.txt"
  done
done
rm "$folder/measured.csv"
if command -v gnuplot >/dev/null; then
  gnuplot -e "folder='$folder'; picture='$folder/sarcos_steps.svg'" "$(dirname "$0")/sarcos_steps.gnuplot"
fi
