#!/bin/sh
# The main job on a bare Debian 12: installs what is missing, builds dyngen, generates the Puma 560, prints
# its operation counts beside the bounds, compiles it, prints torques and speed.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh build-essential cmake ninja-build pkg-config \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev

build=build/demo
log=$build.log
mkdir -p build
echo "Building dyngen in $build (two or three minutes the first time) ..."
if ! { cmake -G Ninja -S . -B $build -DCMAKE_BUILD_TYPE=Release -DDYNGEN_BUILD_TESTS=OFF &&
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
