// SPDX-License-Identifier: MIT
#include "runtime/signals/fourier.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace dyngen::runtime {
namespace {

using Signal = std::vector<std::complex<double>>;

Signal library_fourier(const Signal& x) {
  Eigen::FFT<double> fft;
  Signal X(x.size());
  fft.fwd(X.data(), x.data(), static_cast<int>(x.size()));
  return X;
}

Signal conjugate(Signal x) {
  for (auto& value : x) value = std::conj(value);
  return x;
}

std::size_t largest_prime_factor(std::size_t n) {
  std::size_t largest = 1;
  for (std::size_t p = 2; p * p <= n; ++p) {
    while (n % p == 0) {
      largest = p;
      n /= p;
    }
  }
  return std::max(largest, n);
}

/// As a convolution with a chirp, whose length is a power of two.
Signal chirp_fourier(const Signal& x) {
  const std::size_t N = x.size();
  std::size_t M = 1;
  while (M < 2 * N - 1) M *= 2;
  Signal chirp(N), a(M), b(M);
  for (std::size_t m = 0; m < N; ++m) {
    const std::uint64_t turn = (static_cast<std::uint64_t>(m) * m) % (2 * N);
    const double angle = std::numbers::pi * static_cast<double>(turn) / static_cast<double>(N);
    chirp[m] = std::polar(1.0, -angle);
    a[m] = x[m] * chirp[m];
    b[m] = std::conj(chirp[m]);
    if (m > 0) b[M - m] = b[m];
  }
  a = library_fourier(a);
  b = library_fourier(b);
  for (std::size_t k = 0; k < M; ++k) a[k] *= b[k];
  a = conjugate(library_fourier(conjugate(a)));
  Signal X(N);
  for (std::size_t k = 0; k < N; ++k) X[k] = a[k] * chirp[k] / static_cast<double>(M);
  return X;
}

}  // namespace

Signal fourier(const Signal& x) {
  if (x.size() < 2) return x;
  return largest_prime_factor(x.size()) > 64 ? chirp_fourier(x) : library_fourier(x);
}

Signal inverse_fourier(const Signal& X) {
  Signal x = conjugate(fourier(conjugate(X)));
  for (auto& value : x) value /= static_cast<double>(x.size());
  return x;
}

}  // namespace dyngen::runtime
