#!/bin/sh
# demo.sh: what dyngen and dynid do, on a bare Debian 12.
#
# Installs the packages that are missing, builds dyngen, generates the code of a Puma 560, prints its operation counts
# beside the bounds, torques and speed. Then builds dynid, which finds friction that a model does not have in recordings
# full of noise. Broken off, it goes on from where it was. BUILD is the build folder (build/quick).
set -eu
cd "$(dirname "$0")/.."

build=${BUILD:-build/quick}
log=$build.log
mkdir -p "$(dirname "$build")"
begin=$(date +%s)

cat <<'WORDS'
dyngen in two parts, on two cores in six to seven minutes the first time, in seconds the second:
  1. a robot file becomes C code: the Puma 560, its operation counts, torques and speed (a minute and a half)
  2. dynid finds friction that a model does not have, in recordings full of noise (four to five minutes)
WORDS

# took WHAT SINCE: the seconds that a step took.
took() { echo "($1: $(($(date +%s) - $2)) s)"; }

sh cmake/install_packages.sh build-essential cmake ninja-build ccache pkg-config \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libexpat1-dev nlohmann-json3-dev libboost-dev
took "packages" "$begin"

# quietly COMMAND...: its output goes to the log, whose end is shown if it fails.
quietly() {
  if ! "$@" >>"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "This failed: $*" >&2
    echo "All of its output is in $log. Repeat 'sh cmake/demo.sh' to go on from here." >&2
    exit 1
  fi
}

show() {
  echo
  echo "\$ $*"
  "$@"
}

echo
echo "Part 1. Building dyngen in $build (about a minute the first time) ..."
part=$(date +%s)
: >"$log"
quietly cmake -C cmake/QuickBuild.cmake -G Ninja -S . -B "$build" -DDYNGEN_BUILD_TESTS=OFF
quietly cmake --build "$build" --parallel "$(nproc)" --target dyngen
show "$build/gen/dyngen" robots/puma560.robot -o "$build/puma560.c"
wc -l "$build/puma560.c" "$build/puma560.h" | sed '/total/d'
show "$build/gen/dyngen" robots/puma560.robot --count
show cmake --build "$build" --target puma560_demo
show "$build/runtime/puma560_demo"
took "part 1" "$part"

echo
echo "Part 2. Building dynid (four to five minutes the first time) ..."
part=$(date +%s)
quietly cmake --build "$build" --parallel "$(nproc)" --target dynid
took "building dynid" "$part"

# A motion that is repeated five times, in rows of 10 ms.
motion() {
  awk -v a="$1" -v b="$2" 'BEGIN {
    print "time,q1,q2"
    w = 2 * atan2(0, -1) / 5
    for (k = 0; k <= 2500; ++k) {
      t = k / 100
      printf "%.2f,%.9f,%.9f\n", t, a * sin(w * t) + 0.5 * sin(2 * w * t + b) + 0.2 * cos(5 * w * t + a),
             1.1 * sin(w * t + b) + 0.6 * sin(3 * w * t) + 0.2 * cos(4 * w * t + b)
    }
  }'
}
dynid=$build/runtime/dynid
story=$build/concealed
mkdir -p "$story"
{ sed '/^stop/d' robots/planar2r.robot; echo "effect load_friction joint=1 mu=0.05"; echo stop; } >"$story/machine.robot"
motion 1.2 0.3 >"$story/motion1.csv"
motion 0.7 1.9 >"$story/motion2.csv"
motion 1.0 4.0 >"$story/motion3.csv"
echo
echo "Three recordings of an arm whose first gear loses 5 % of its load. No row of the model says so."
for run in 1 2 3; do
  quietly "$dynid" simulate robots/planar2r.robot --plant "$story/machine.robot" --controller ff \
    --trajectory "$story/motion$run.csv" --encoder 2e-5 --encoder-noise 1e-5 --torque-noise 1 --seed $run \
    -o "$story/run$run.csv"
done
show "$dynid" diagnose robots/planar2r.robot "$story/run1.csv" "$story/run2.csv" \
  --holdout "$story/run3.csv" -o "$story/improved.robot" --report "$story/report.html"
took "part 2" "$part"
took "all" "$begin"

cat <<WORDS

What to try next:
  $build/gen/dyngen robots/puma560.robot --explain --drawing puma.svg     # what was read, in words and as a picture
  $dynid fit robots/planar2r.robot $story/run1.csv -o identified.robot    # parameters with standard deviations
  xdg-open $story/report.html                                             # the diagnosis as a page; it opens offline
WORDS
