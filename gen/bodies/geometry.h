// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace dyngen {

/// A number of a description, and what is worked out from it: decimals of 17 digits and products of
/// a few rotations keep 1e-17 of their size.
using Real = long double;

struct Vector3 {
  std::array<Real, 3> at{};

  Real& operator[](std::size_t i) { return at[i]; }
  const Real& operator[](std::size_t i) const { return at[i]; }
};

Vector3 operator+(const Vector3& a, const Vector3& b);
Vector3 operator-(const Vector3& a, const Vector3& b);
Vector3 operator-(const Vector3& a);
Vector3 operator*(Real factor, const Vector3& a);
Real dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
Real norm(const Vector3& a);

/// A 3 x 3 matrix, row by row.
struct Matrix3 {
  std::array<Vector3, 3> rows{};

  Vector3& operator[](std::size_t i) { return rows[i]; }
  const Vector3& operator[](std::size_t i) const { return rows[i]; }
  [[nodiscard]] Vector3 column(std::size_t k) const {
    return {{rows[0][k], rows[1][k], rows[2][k]}};
  }
  static Matrix3 identity();
  static Matrix3 of_columns(const Vector3& x, const Vector3& y, const Vector3& z);
};

Matrix3 operator+(const Matrix3& a, const Matrix3& b);
Matrix3 operator*(Real factor, const Matrix3& a);
Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Vector3 operator*(const Matrix3& a, const Vector3& v);
Matrix3 transposed(const Matrix3& a);

/// A frame in another one: point = R point' + p.
struct Pose {
  Matrix3 R = Matrix3::identity();
  Vector3 p{};
};

Pose operator*(const Pose& a, const Pose& b);
Vector3 operator*(const Pose& a, const Vector3& point);
Pose inverse(const Pose& a);

/// Sine and cosine; of multiples of a right angle exactly 0 or 1.
struct SineCosine {
  Real sine = 0;
  Real cosine = 1;
};
SineCosine sine_cosine(Real angle);

/// The nearest multiple of pi/12 if the angle is within `tolerance` of it, else the angle.
/// @param angle, tolerance  rad
Real rounded_angle(Real angle, Real tolerance);

inline constexpr Real kRealPi = std::numbers::pi_v<Real>;

Matrix3 turn_x(Real angle);
Matrix3 turn_y(Real angle);
Matrix3 turn_z(Real angle);
/// About a unit vector; Rodrigues' formula.
Matrix3 turn_about(const Vector3& axis, Real angle);
/// Fixed axes x, y, z as URDF has them: Rz(yaw) Ry(pitch) Rx(roll).
Matrix3 turn_rpy(const Vector3& rpy);
/// Of a quaternion w x y z of any length but 0.
Matrix3 turn_quaternion(const std::array<Real, 4>& wxyz);

/// m (p.p 1 - p p^T): what the moments about a point at -p from the centre of mass have more.
Matrix3 parallel_axes(Real mass, const Vector3& p);

/// R A R^T
Matrix3 turned(const Matrix3& R, const Matrix3& A);

/// Eigenvalues of a symmetric matrix in rising order; by Jacobi's rotations.
/// @param axes  null, or where their unit vectors go, as columns of a rotation
Vector3 principal_moments(const Matrix3& A, Matrix3* axes = nullptr);

}  // namespace dyngen
