#!/bin/sh
# All tests on a bare Debian 12: installs what is missing, builds everything, runs everything.
set -eu
cd "$(dirname "$0")/.."

sh cmake/install_packages.sh build-essential cmake ninja-build ccache pkg-config git clang \
  libginac-dev libcln-dev libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev nlohmann-json3-dev \
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev liborocos-kdl-dev libmujoco-dev \
  libdart-dev libceres-dev libnlopt-dev libopenmpi-dev openmpi-bin python3-numpy gnuplot-nox

build=build/test
cmake -G Ninja -S . -B $build -DCMAKE_BUILD_TYPE=Release -DDYNGEN_BUILD_BENCH=ON \
  -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
cmake --build $build
ctest --test-dir $build --parallel "$(nproc)" --output-on-failure --output-log $build/ctest.log
