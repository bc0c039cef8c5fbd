#!/bin/sh
# tidy.sh [PATTERN...]: clang-tidy (.clang-tidy) over the sources of gen/ and runtime/, several compiled as one; with
# patterns over the sources whose paths match one, each alone. BUILD is the build folder (build/tidy). JOBS: how many at
# once.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh clang clang-tidy cmake ninja-build pkg-config \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libexpat1-dev nlohmann-json3-dev \
  libboost-dev libceres-dev libnlopt-dev
build=${BUILD:-build/tidy}
together=OFF
checks=
if [ $# -eq 0 ]; then
  together=ON
  checks=-bugprone-suspicious-include  # of sources, by the one that holds several
fi
cmake -G Ninja -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_UNITY_BUILD=$together \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DDYNGEN_PRECOMPILE=OFF -DDYNGEN_BUILD_TESTS=OFF -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++

# sources that the build makes
cmake --build "$build" --target gen/effect_texts.cpp runtime/report/page_template.cpp
# the demo includes what dyngen makes
sed -n 's/^ *"file": "\(.*\.c[px][px]\)",*$/\1/p' "$build/compile_commands.json" | grep -v puma560_demo |
  sort -u > "$build/compiled_files"
if [ $together = ON ]; then
  cp "$build/compiled_files" "$build/tidy_files"
else
  for pattern in "$@"; do git ls-files 'gen/*.cpp' 'runtime/*.cpp' | grep -E "$pattern" || true; done |
    grep -v puma560_demo | sort -u > "$build/tidy_files"
fi
[ -s "$build/tidy_files" ] || { echo "no source of gen/ or runtime/ matches: $*" >&2; exit 2; }
xargs -P "${JOBS:-$(nproc)}" -n 1 nice -n 10 clang-tidy -p "$build" --quiet \
  --config-file=.clang-tidy --checks="$checks" < "$build/tidy_files"
echo "$(wc -l < "$build/tidy_files") files are tidy"
