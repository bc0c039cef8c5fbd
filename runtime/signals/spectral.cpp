// SPDX-License-Identifier: MIT
#include "runtime/signals/spectral.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "runtime/signals/fourier.h"

namespace dyngen::runtime {
namespace {

using Signal = std::vector<std::complex<double>>;

}  // namespace

Eigen::Index line_below(double cutoff_hz, Eigen::Index samples, double sample_time) {
  const double period = static_cast<double>(samples) * sample_time;
  const Eigen::Index last = (samples - 1) / 2;
  const auto limit = static_cast<double>(last);
  // A cut-off that is meant to be a line should find it, whatever the rounding.
  const double line = std::floor(cutoff_hz * period * (1 + 1e-9) + 1e-9);
  return static_cast<Eigen::Index>(std::clamp(line, 0.0, std::max(limit, 0.0)));
}

SpectralStates spectral_derivatives(const Eigen::MatrixXd& columns, double sample_time,
                                    Eigen::Index last_line) {
  const Eigen::Index N = columns.rows();
  if (N < 1 || !(sample_time > 0)) {
    throw std::invalid_argument(fmt::format(
        "spectral_derivatives(): {} samples of {} s, needed: at least one, of positive length", N,
        sample_time));
  }
  if (last_line < 0 || 2 * last_line >= std::max<Eigen::Index>(N, 1)) {
    throw std::invalid_argument(fmt::format(
        "spectral_derivatives(): last_line {} is not in 0..{}, below half of the {} samples",
        last_line, (N - 1) / 2, N));
  }
  const double fundamental = 2 * std::numbers::pi / (static_cast<double>(N) * sample_time);
  const auto size = static_cast<std::size_t>(N);
  SpectralStates states{columns, columns, columns};
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    Signal x(size);
    for (std::size_t k = 0; k < size; ++k) x[k] = columns(static_cast<Eigen::Index>(k), j);
    const Signal X = fourier(x);
    // Both signals are real: one transform brings back position + i velocity.
    Signal both(size), curved(size);
    for (Eigen::Index line = -last_line; line <= last_line; ++line) {
      const auto k = static_cast<std::size_t>(line < 0 ? line + N : line);
      const double w = fundamental * static_cast<double>(line);
      both[k] = X[k] * (1 - w);  // X + i (i w X)
      curved[k] = -w * w * X[k];
    }
    both = inverse_fourier(both);
    curved = inverse_fourier(curved);
    for (std::size_t k = 0; k < size; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      states.position(row, j) = both[k].real();
      states.velocity(row, j) = both[k].imag();
      states.acceleration(row, j) = curved[k].real();
    }
  }
  return states;
}

}  // namespace dyngen::runtime
