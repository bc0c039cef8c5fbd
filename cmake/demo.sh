#!/bin/sh
# The main jobs on a bare Debian 12: installs what is missing, builds dyngen, generates the Puma 560, prints
# its operation counts beside the bounds, compiles it, prints torques and speed. Then dynid: recordings of an arm whose
# gear has friction that the model does not know, hidden in noise; what is found, and the fit before and after.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh build-essential cmake ninja-build pkg-config \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev nlohmann-json3-dev libboost-dev

build=build/demo
log=$build.log
mkdir -p build
echo "Building dyngen in $build (two or three minutes the first time) ..."
if ! { cmake -G Ninja -S . -B $build -DCMAKE_BUILD_TYPE=Release -DDYNGEN_BUILD_TESTS=OFF \
         -DDYNGEN_PRECOMPILE=ON -DCMAKE_UNITY_BUILD=ON &&
       cmake --build $build --target dyngen; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi

show() {
  echo
  echo "\$ $*"
  "$@"
}
show $build/gen/dyngen robots/puma560.robot -o $build/puma560.c
wc -l $build/puma560.c $build/puma560.h | sed '/total/d'
show $build/gen/dyngen robots/puma560.robot --count
show cmake --build $build --target puma560_demo
show $build/runtime/puma560_demo

echo
echo "Building dynid (some minutes more the first time) ..."
if ! cmake --build $build --target dynid >>"$log" 2>&1; then
  tail -n 60 "$log" >&2
  exit 1
fi

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
story=$build/concealed
mkdir -p $story
{ sed '/^stop/d' robots/planar2r.robot; echo "effect load_friction joint=1 mu=0.05"; echo stop; } >$story/machine.robot
motion 1.2 0.3 >$story/motion1.csv
motion 0.7 1.9 >$story/motion2.csv
motion 1.0 4.0 >$story/motion3.csv
echo "Three recordings of an arm whose first gear loses 5 % of its load, which no row of the model says."
for run in 1 2 3; do
  $build/runtime/dynid simulate robots/planar2r.robot --plant $story/machine.robot --controller ff \
    --trajectory $story/motion$run.csv --encoder 2e-5 --encoder-noise 1e-5 --torque-noise 1 --seed $run \
    -o $story/run$run.csv >>"$log"
done
show $build/runtime/dynid diagnose robots/planar2r.robot $story/run1.csv $story/run2.csv \
  --holdout $story/run3.csv -o $story/improved.robot --report $story/report.html
