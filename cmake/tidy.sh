#!/bin/sh
# tidy.sh [PATTERN...]: clang-tidy (.clang-tidy) over the sources of gen/ and runtime/, or over those whose paths match a
# pattern. BUILD is the build folder (build/tidy); every file is compiled alone there. JOBS: how many at once.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh clang clang-tidy cmake ninja-build pkg-config \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libexpat1-dev nlohmann-json3-dev \
  libboost-dev libceres-dev libnlopt-dev
build=${BUILD:-build/tidy}
cmake -G Ninja -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_UNITY_BUILD=OFF -DDYNGEN_BUILD_TESTS=OFF \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++

if [ $# -eq 0 ]; then set -- '^gen/' '^runtime/'; fi
for pattern in "$@"; do git ls-files 'gen/*.cpp' 'runtime/*.cpp' | grep -E "$pattern" || true; done |
  grep -v 'puma560_demo' | sort -u > "$build/tidy_files"  # the demo includes what dyngen makes
[ -s "$build/tidy_files" ] || { echo "no source of gen/ or runtime/ matches: $*" >&2; exit 2; }
xargs -P "${JOBS:-$(nproc)}" -n 1 nice -n 10 clang-tidy -p "$build" --quiet < "$build/tidy_files"
echo "$(wc -l < "$build/tidy_files") files are tidy"
