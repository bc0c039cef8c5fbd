// SPDX-License-Identifier: MIT
#include "runtime/signals/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dyngen::runtime {
namespace {

TEST(Fourier, EqualsTheSumForAnyLength) {
  for (const std::size_t N : {1U, 2U, 3U, 8U, 30U, 67U, 2U * 101U, 499U}) {
    std::vector<std::complex<double>> x(N);
    for (std::size_t m = 0; m < N; ++m) {
      x[m] = {std::cos(static_cast<double>(m * m)), std::sin(static_cast<double>(3 * m))};
    }
    const auto X = fourier(x);
    const auto back = inverse_fourier(X);
    ASSERT_EQ(X.size(), N);
    for (std::size_t k = 0; k < N; ++k) {
      std::complex<double> sum = 0;
      for (std::size_t m = 0; m < N; ++m) {
        const double turn = static_cast<double>((k * m) % N) / static_cast<double>(N);
        sum += x[m] * std::polar(1.0, -2 * std::numbers::pi * turn);
      }
      EXPECT_LT(std::abs(X[k] - sum), 1e-11) << N << " " << k;
      EXPECT_LT(std::abs(back[k] - x[k]), 1e-13) << N << " " << k;
    }
  }
}

}  // namespace
}  // namespace dyngen::runtime
