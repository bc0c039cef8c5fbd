// SPDX-License-Identifier: MIT
// record FILE: writes a recording of the planar arm, which moves as its own code says. Built by the
// flags that pkg-config gives, without CMake.
#include <array>
#include <cmath>
#include <numbers>

#include "planar.h"
#include "runtime/estimation/matrix_products.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/writer.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr int kSamples = 2000;
  constexpr double kStep = 0.005;
  dyngen::runtime::Recording run;
  run.time.resize(kSamples);
  run.q.resize(kSamples, PLANAR_NQ);
  run.tau.resize(kSamples, PLANAR_NQ);
  run.run_starts = {0};
  for (int k = 0; k < kSamples; ++k) {
    const double t = kStep * k;
    run.time[k] = t;
    std::array<double, PLANAR_NQ> q{}, dq{}, ddq{}, tau{};
    for (std::size_t j = 0; j < PLANAR_NQ; ++j) {
      for (const int harmonic : {1, 2, 5}) {
        const double w = 2 * std::numbers::pi / 5 * harmonic;
        const double size = 1.0 / harmonic, angle = w * t + 1.3 * static_cast<double>(j) * harmonic;
        q[j] += size * std::sin(angle);
        dq[j] += size * w * std::cos(angle);
        ddq[j] -= size * w * w * std::sin(angle);
      }
    }
    planar_id(q.data(), dq.data(), ddq.data(), tau.data());
    for (int j = 0; j < PLANAR_NQ; ++j) {
      run.q(k, j) = q[static_cast<std::size_t>(j)];
      run.tau(k, j) = tau[static_cast<std::size_t>(j)];
    }
  }
  dyngen::runtime::write_recording(run, argv[1]);

  // What needs the other libraries: packed files, products of large matrices.
  const dyngen::runtime::Recording read = dyngen::runtime::read_recording(argv[1]);
  const Eigen::MatrixXd squares = dyngen::runtime::transposed_product(run.tau, read.tau);
  return squares == squares.transpose() && read.samples() == kSamples ? 0 : 1;
}
