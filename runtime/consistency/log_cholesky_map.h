// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

/// The maps of pseudo_inertia.h for any scalar, so that derivatives can be had by the chain rule.
namespace dyngen::runtime::log_cholesky_map {

template <typename T>
using Ten = Eigen::Matrix<T, 10, 1>;
template <typename T>
using Matrix4 = Eigen::Matrix<T, 4, 4>;

/// theta = [alpha, d1, d2, d3, s12, s23, s13, t1, t2, t3] -> upper triangular U with a positive
/// diagonal. Source: Rucker and Wensing, "Smooth parameterization of rigid-body inertia", 2022.
template <typename T>
Matrix4<T> factor(const Ten<T>& theta) {
  using std::exp;
  const T& alpha = theta[0];
  const T size = exp(alpha);
  Matrix4<T> U = Matrix4<T>::Zero();
  for (int i = 0; i < 3; ++i) {
    U(i, i) = exp(alpha + theta[1 + i]);
    U(i, 3) = size * theta[7 + i];
  }
  U(0, 1) = size * theta[4];
  U(1, 2) = size * theta[5];
  U(0, 2) = size * theta[6];
  U(3, 3) = size;
  return U;
}

/// U U', of which the products with the zeros below the diagonal are left out.
template <typename T>
Matrix4<T> square(const Matrix4<T>& U) {
  Matrix4<T> J;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      T sum = U(i, j) * U(j, j);
      for (int k = j + 1; k < 4; ++k) sum += U(i, k) * U(j, k);
      J(i, j) = sum;
      J(j, i) = sum;
    }
  }
  return J;
}

/// Pseudo-inertia -> XX XY XZ YY YZ ZZ MX MY MZ M: I = tr(Sigma) 1 - Sigma.
template <typename T>
Ten<T> ten_parameters(const Matrix4<T>& J) {
  Ten<T> ten;
  ten << J(1, 1) + J(2, 2), -J(0, 1), -J(0, 2), J(0, 0) + J(2, 2), -J(1, 2), J(0, 0) + J(1, 1),
      J(0, 3), J(1, 3), J(2, 3), J(3, 3);
  return ten;
}

/// The ten elements 11 12 13 14 22 23 24 33 34 44 of a symmetric matrix.
template <typename T>
Ten<T> upper_elements(const Matrix4<T>& S) {
  Ten<T> ten;
  int place = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) ten[place++] = S(i, j);
  }
  return ten;
}

template <typename T>
Matrix4<T> from_upper_elements(const Ten<T>& elements) {
  Matrix4<T> S;
  int place = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      S(i, j) = elements[place];
      S(j, i) = elements[place++];
    }
  }
  return S;
}

}  // namespace dyngen::runtime::log_cholesky_map
