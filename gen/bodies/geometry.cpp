// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dyngen {

Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
Vector3 operator-(const Vector3& a) { return {{-a[0], -a[1], -a[2]}}; }
Vector3 operator*(Real factor, const Vector3& a) {
  return {{factor * a[0], factor * a[1], factor * a[2]}};
}
Real dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
Real norm(const Vector3& a) { return std::hypot(a[0], a[1], a[2]); }

Matrix3 Matrix3::identity() { return {{{{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}}}; }

Matrix3 Matrix3::of_columns(const Vector3& x, const Vector3& y, const Vector3& z) {
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = {{x[i], y[i], z[i]}};
  return result;
}

Matrix3 operator+(const Matrix3& a, const Matrix3& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
Matrix3 operator*(Real factor, const Matrix3& a) {
  return {{factor * a[0], factor * a[1], factor * a[2]}};
}
Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 column = a * b.column(k);
    for (std::size_t i = 0; i < 3; ++i) result[i][k] = column[i];
  }
  return result;
}
Vector3 operator*(const Matrix3& a, const Vector3& v) {
  return {{dot(a[0], v), dot(a[1], v), dot(a[2], v)}};
}
Matrix3 transposed(const Matrix3& a) { return {{a.column(0), a.column(1), a.column(2)}}; }

Pose operator*(const Pose& a, const Pose& b) { return {a.R * b.R, a.R * b.p + a.p}; }
Vector3 operator*(const Pose& a, const Vector3& point) { return a.R * point + a.p; }
Pose inverse(const Pose& a) {
  const Matrix3 back = transposed(a.R);
  return {back, -(back * a.p)};
}

SineCosine sine_cosine(Real angle) {
  constexpr Real kRightAngle = kRealPi / 2;
  constexpr Real kExact = 1e-18L;  // rad: what a long double right angle is off
  const Real quarters = std::round(angle / kRightAngle);
  if (std::fabs(angle - quarters * kRightAngle) <=
      kExact * std::max(Real(1), std::fabs(quarters))) {
    const int quadrant = static_cast<int>(std::fmod(quarters, Real(4)));
    switch ((quadrant + 4) % 4) {
      case 0:
        return {0, 1};
      case 1:
        return {1, 0};
      case 2:
        return {0, -1};
      default:
        return {-1, 0};
    }
  }
  return {std::sin(angle), std::cos(angle)};
}

Real rounded_angle(Real angle, Real tolerance) {
  constexpr Real kStep = kRealPi / 12;
  const Real nearest = std::round(angle / kStep) * kStep;
  return std::fabs(angle - nearest) <= tolerance ? nearest : angle;
}

Matrix3 turn_x(Real angle) {
  const auto [s, c] = sine_cosine(angle);
  return {{{{{1, 0, 0}}, {{0, c, -s}}, {{0, s, c}}}}};
}
Matrix3 turn_y(Real angle) {
  const auto [s, c] = sine_cosine(angle);
  return {{{{{c, 0, s}}, {{0, 1, 0}}, {{-s, 0, c}}}}};
}
Matrix3 turn_z(Real angle) {
  const auto [s, c] = sine_cosine(angle);
  return {{{{{c, -s, 0}}, {{s, c, 0}}, {{0, 0, 1}}}}};
}

Matrix3 turn_about(const Vector3& axis, Real angle) {
  const auto [s, c] = sine_cosine(angle);
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[i][k] = (1 - c) * axis[i] * axis[k] + (i == k ? c : 0);
    }
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    result[l][j] += s * axis[i];
    result[j][l] -= s * axis[i];
  }
  return result;
}

Matrix3 turn_rpy(const Vector3& rpy) { return turn_z(rpy[2]) * turn_y(rpy[1]) * turn_x(rpy[0]); }

Matrix3 turn_quaternion(const std::array<Real, 4>& wxyz) {
  const auto [w, x, y, z] = wxyz;
  const Real square = w * w + x * x + y * y + z * z;
  const Real two = 2 / square;
  return {{{{{1 - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)}},
            {{two * (x * y + w * z), 1 - two * (x * x + z * z), two * (y * z - w * x)}},
            {{two * (x * z - w * y), two * (y * z + w * x), 1 - two * (x * x + y * y)}}}}};
}

Matrix3 parallel_axes(Real mass, const Vector3& p) {
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result[i][i] = mass * (p[j] * p[j] + p[k] * p[k]);
    result[j][k] = result[k][j] = -mass * p[j] * p[k];
  }
  return result;
}

Matrix3 turned(const Matrix3& R, const Matrix3& A) {
  Matrix3 result = R * A * transposed(R);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    result[i][k] = result[k][i] = (result[i][k] + result[k][i]) / 2;
  }
  return result;
}

Vector3 principal_moments(const Matrix3& A, Matrix3* axes) {
  Matrix3 J = A, V = Matrix3::identity();
  constexpr int kSweeps = 20;  // each squares what is left
  for (int step = 0; step < 3 * kSweeps; ++step) {
    const auto i = static_cast<std::size_t>(step % 3), k = (i + 1) % 3;
    if (J[i][k] == 0) continue;
    // the smaller of the two angles: with the larger one sweeps may go round for ever
    const Real apart = J[i][i] - J[k][k];
    const Real angle = apart == 0 ? std::atan(Real(1)) : std::atan(2 * J[i][k] / apart) / 2;
    Vector3 axis;
    axis[3 - i - k] = 1;
    const Matrix3 turn = turn_about(axis, angle);
    J = transposed(turn) * J * turn;
    V = V * turn;
  }
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return J[a][a] < J[b][b]; });
  if (axes != nullptr) {
    const Vector3 x = V.column(order[0]), y = V.column(order[1]);
    *axes = Matrix3::of_columns(x, y, cross(x, y));
  }
  return {{J[order[0]][order[0]], J[order[1]][order[1]], J[order[2]][order[2]]}};
}

}  // namespace dyngen
