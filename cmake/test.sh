#!/bin/sh
# test.sh [all|build]: the tests, on a bare Debian 12. Installs the packages that are missing, builds what the tests need,
# and runs all tests but those that are labelled `slow`. With `all`: builds the studies, benchmarks and the blind suite
# too, and runs all tests, on five times as many random robots. With `build`: builds the same, and runs none.
# BUILD is the build folder (build/quick).
set -eu
cd "$(dirname "$0")/.."

what=${1:-}
case $what in
  "") without="--label-exclude slow" benchmarks=OFF cases=20 targets=all ;;
  all) without="" benchmarks=ON cases=100 targets="all studies blind" ;;
  build) without="" benchmarks=ON cases=33 targets="all studies blind" ;;
  *) echo "usage: sh cmake/test.sh [all|build]" >&2; exit 2 ;;
esac
begin=$(date +%s)
took() { echo "($1: $(($(date +%s) - $2)) s)"; }

sh cmake/install_packages.sh build-essential cmake ninja-build ccache pkg-config git clang \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libexpat1-dev nlohmann-json3-dev \
  libopenblas-pthread-dev libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev liborocos-kdl-dev libkdl-parser-dev libmujoco-dev \
  libdart-dev libboost-dev libceres-dev libnlopt-dev libopenmpi-dev openmpi-bin python3-numpy gnuplot-nox \
  libmatio-dev libhdf5-dev libzip-dev libsqlite3-dev liblz4-dev libzstd-dev libbz2-dev libyaml-cpp-dev \
  python3-scipy python3-h5py python3-lz4 python3-zstandard python3-jsonschema
took "packages" "$begin"

build=${BUILD:-build/quick}
step=$(date +%s)
# two checkouts share what the cache holds, and precompiled headers are kept in it
export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$PWD}" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
cmake -C cmake/QuickBuild.cmake -G Ninja -S . -B "$build" -DDYNGEN_BUILD_TESTS=ON -DDYNGEN_BUILD_BENCH=$benchmarks \
  -DDYNGEN_RANDOM_CASES=$cases
# shellcheck disable=SC2086  # targets, in words
cmake --build "$build" --parallel "$(nproc)" --target $targets
took "build" "$step"
[ "$what" != build ] || exit 0

step=$(date +%s)
# shellcheck disable=SC2086  # options, in words
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --output-log "$build/ctest.log" $without
took "tests" "$step"
took "all" "$begin"
if [ -n "$without" ]; then
  slow=$(ctest --test-dir "$build" --show-only --label-regex slow | sed -n 's/^Total Tests: //p')
  echo "$slow slow tests were left out; 'sh cmake/test.sh all' runs them too."
fi
