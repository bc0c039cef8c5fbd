#!/bin/sh
# coverage.sh [TARGET...]: how many lines of gen/ and runtime/ tests run. Builds test programs with g++ --coverage, runs
# them, and prints the share of lines by folder and in all. Without a TARGET: the unit tests of both parts.
# BUILD is the build folder (build/coverage); FILTER: GoogleTest's filter; JOBS: compilations at once.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh build-essential cmake ninja-build pkg-config python3 \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libexpat1-dev nlohmann-json3-dev \
  libgtest-dev libgmock-dev librapidcheck-dev libboost-dev
build=${BUILD:-build/coverage}
# one level of optimisation: without it the tests of the runtime take some ten times as long
cmake -C cmake/QuickBuild.cmake -G Ninja -S . -B "$build" -DDYNGEN_BUILD_TESTS=ON -DDYNGEN_RANDOM_CASES=5 \
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER=gcc -DCMAKE_CXX_COMPILER=g++ \
  -DCMAKE_C_FLAGS="--coverage" -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=atomic" \
  -DCMAKE_CXX_FLAGS_DEBUG="-O1" -DCMAKE_C_FLAGS_DEBUG="-O1"

build=$(cd "$build" && pwd)
all=$(ninja -C "$build" -t targets all | sed -n 's/^\([a-z_0-9]*_tests\): phony$/\1/p')
if [ $# -eq 0 ]; then
  # shellcheck disable=SC2046  # targets, in words
  set -- $(echo "$all" | grep -E '^(gen|robot_input|runtime_[a-z_]*)_tests$')
fi
cmake --build "$build" --parallel "${JOBS:-$(nproc)}" --target "$@"

# slow tests repeat what others run, some hundred times
slow=$(ctest --test-dir "$build" --show-only --label-regex slow | sed -n 's/^ *Test *#[0-9]*: *//p' | paste -sd: -)
# counts of an earlier run are not counted again
find "$build" -name '*.gcda' -delete
for target in "$@"; do
  program=$(find "$build" -type f -name "$target" -perm -u+x | head -n 1)
  [ -n "$program" ] || { echo "$target: its program is not in $build" >&2; exit 1; }
  (cd "$build" && "$program" --gtest_brief=1 --gtest_filter="${FILTER:-*}-$slow") ||
    echo "$target: some tests failed; their lines count all the same" >&2
done
python3 cmake/coverage.py "$build"
