#!/bin/sh
# optional_parts.sh: dyngen on a bare Debian 12 as root (bare.sh calls it in a tree of its own; it installs and removes
# packages). Configured with no optional package, with each alone and with all of them. Built with none: what remains
# works, and what needs a package says so, with its name, before any work.
set -eu
cd "$(dirname "$0")/../.."

needed="build-essential cmake ninja-build pkg-config libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev"
build=build/quick
begin=$(date +%s)

fail() {
  echo "optional_parts.sh: $*" >&2
  exit 1
}
took() { echo "($1: $(($(date +%s) - $2)) s)"; }

# configure FOLDER [OPTION...]: its output is in FOLDER.log
configure() {
  folder=$1
  shift
  if ! cmake -C cmake/QuickBuild.cmake -G Ninja -S . -B "$folder" "$@" >"$folder.log" 2>&1; then
    cat "$folder.log" >&2
    fail "cmake failed in $folder"
  fi
}

# expect_parts LOG PACKAGE...: these were found, of those that cmake tells of, and no others.
expect_parts() {
  list=$1
  shift
  found=$(sed -n 's/^--   found     \([^:]*\):.*/\1/p' "$list" | sort | tr '\n' ' ')
  wanted=$(printf '%s\n' "$@" | sort | sed '/^$/d' | tr '\n' ' ')
  [ "$found" = "$wanted" ] || fail "$list: found '$found', expected '$wanted'"
}

# refused PACKAGE COMMAND...: ends with 2, names the package, reads and writes nothing.
refused() {
  package=$1
  shift
  code=0
  "$@" >build/refused.txt 2>&1 || code=$?
  [ "$code" -eq 2 ] || fail "'$*' ended with $code, expected 2: $(cat build/refused.txt)"
  grep -q "$package" build/refused.txt || fail "'$*' does not name $package: $(cat build/refused.txt)"
  echo "refused as it should be: $(head -n 1 build/refused.txt)"
}

mkdir -p build
# shellcheck disable=SC2086  # one word each
sh cmake/install_packages.sh $needed
took "packages" "$begin"

step=$(date +%s)
configure build/configured
expect_parts build/configured.log ""
grep -q "left out  .*: the tests" build/configured.log || fail "it is not said that the tests are left out"
if cmake -S . -B build/tests -DDYNGEN_BUILD_TESTS=ON >build/tests.log 2>&1; then
  fail "tests that were asked for are left out without an error"
fi
grep -q "apt-get install .*libgtest-dev" build/tests.log || fail "the packages of the tests are not named"
if cmake -S . -B build/bundle -DDYNGEN_BUILD_TESTS=OFF -DDYNGEN_BUNDLE_REPORT=ON >build/bundle.log 2>&1; then
  fail "the page is bundled without node"
fi
grep -q "apt-get install nodejs npm" build/bundle.log || fail "node's packages are not named"

for package in libopenblas-pthread-dev zlib1g-dev libboost-dev nlohmann-json3-dev libceres-dev libnlopt-dev libopenmpi-dev \
  libexpat1-dev libyaml-cpp-dev libmatio-dev libhdf5-dev libzip-dev libsqlite3-dev liblz4-dev libzstd-dev libbz2-dev gnuplot-nox nodejs; do
  apt-mark showmanual | sort >build/manual.before
  sh cmake/install_packages.sh "$package" >/dev/null
  rm -rf build/configured
  configure build/configured
  case $package in
    # Ceres's solvers multiply by a BLAS of their own, whose development files come along
    nodejs) expect_parts build/configured.log "" ;;
    *) grep -q "found     $package:" build/configured.log || fail "$package alone is not found: $(cat build/configured.log)" ;;
  esac
  echo "configured with $package alone: $(sed -n 's/^--   found     \([^:]*\):.*/\1/p' build/configured.log | tr '\n' ' ')"
  apt-get purge -q -y --auto-remove "$package" >build/purge.log 2>&1 </dev/null ||
    fail "$package cannot be removed: $(tail -n 5 build/purge.log)"
  # shellcheck disable=SC2086
  sh cmake/install_packages.sh $needed
done
took "configured with each alone" "$step"

step=$(date +%s)
configure $build
expect_parts $build.log ""
cmake --build $build >>$build.log 2>&1 || {
  tail -n 60 $build.log >&2
  fail "it does not build without optional packages"
}
if grep -q "warning:" $build.log; then
  grep "warning:" $build.log >&2
  fail "the build without optional packages warns"
fi
took "build with none" "$step"

step=$(date +%s)
dynid=$build/runtime/dynid
$build/gen/dyngen robots/puma560.robot -o build/puma560.c
$build/runtime/puma560_demo >/dev/null
$dynid --version
awk -f tests/package/pendulum.awk >build/run.csv
$dynid fit tests/package/pendulum.robot build/run.csv -o build/identified.robot
$build/gen/dyngen build/identified.robot -o build/identified.c
$dynid diagnose tests/package/pendulum.robot build/run.csv -o build/improved.robot
$build/gen/dyngen build/improved.robot -o build/improved.c

fit="$dynid fit tests/package/pendulum.robot absent.csv"
# shellcheck disable=SC2086
{
  refused gnuplot-nox $fit --figures build/figures
  refused nlohmann-json3-dev $fit --json build/fit.json
  refused nlohmann-json3-dev $fit --report build/fit.html
  refused libceres-dev $fit --consistent
  refused libexpat1-dev $dynid fit absent.urdf absent.csv
  refused libyaml-cpp-dev $fit --map absent.yaml
  refused zlib1g-dev $fit.gz
  refused libopenmpi-dev env OMPI_COMM_WORLD_SIZE=2 $fit
  refused libnlopt-dev $dynid excite tests/package/pendulum.robot -o build/motion.csv
  refused libboost-dev $dynid simulate tests/package/pendulum.robot --trajectory absent.csv -o build/simulated.csv
  refused gnuplot-nox $dynid effects --markdown build/effects.md --figures build/figures
}
for path in build/figures build/fit.json build/fit.html build/motion.csv build/simulated.csv; do
  [ ! -e $path ] || fail "$path was written by a command that was refused"
done
took "what remains" "$step"

step=$(date +%s)
all="libopenblas-pthread-dev zlib1g-dev libboost-dev nlohmann-json3-dev libceres-dev libnlopt-dev libopenmpi-dev gnuplot-nox
  libexpat1-dev libyaml-cpp-dev libmatio-dev libhdf5-dev libzip-dev libsqlite3-dev liblz4-dev libzstd-dev libbz2-dev"
# shellcheck disable=SC2086  # one word each
sh cmake/install_packages.sh $all >/dev/null
rm -rf $build
configure $build -DDYNGEN_BUILD_TESTS=OFF
# shellcheck disable=SC2086
expect_parts $build.log $all
took "configured with all" "$step"
step=$(date +%s)
cmake --build $build >>$build.log 2>&1 || {
  tail -n 60 $build.log >&2
  fail "it does not build with all optional packages"
}
$dynid --version | grep -q "^without" && fail "dynid says that a package is absent: $($dynid --version)"
$dynid fit tests/package/pendulum.robot build/run.csv --json build/fit.json --report build/fit.html \
  --figures build/figures >/dev/null
took "build with all" "$step"
took "all parts" "$begin"
