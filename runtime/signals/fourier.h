// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <vector>

namespace dyngen::runtime {

/// X[k] = sum_m x[m] exp(-2 pi i k m / N), for any N >= 1: also for a large prime N the time grows
/// as N log N (Bluestein 1970).
std::vector<std::complex<double>> fourier(const std::vector<std::complex<double>>& x);

/// The inverse: x[m] = 1/N sum_k X[k] exp(2 pi i k m / N).
std::vector<std::complex<double>> inverse_fourier(const std::vector<std::complex<double>>& X);

}  // namespace dyngen::runtime
