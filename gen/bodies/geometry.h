// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace dyngen {

/// A number of a description, and what is worked out from it: decimals of 17 digits and products of
/// a few rotations keep 1e-17 of their size.
using Real = long double;

struct RealVector {
  std::array<Real, 3> at{};

  Real& operator[](std::size_t i) { return at[i]; }
  const Real& operator[](std::size_t i) const { return at[i]; }
};

RealVector operator+(const RealVector& a, const RealVector& b);
RealVector operator-(const RealVector& a, const RealVector& b);
RealVector operator-(const RealVector& a);
RealVector operator*(Real factor, const RealVector& a);
Real dot(const RealVector& a, const RealVector& b);
RealVector cross(const RealVector& a, const RealVector& b);
Real norm(const RealVector& a);

/// A 3 x 3 matrix, row by row.
struct RealMatrix {
  std::array<RealVector, 3> rows{};

  RealVector& operator[](std::size_t i) { return rows[i]; }
  const RealVector& operator[](std::size_t i) const { return rows[i]; }
  [[nodiscard]] RealVector column(std::size_t k) const {
    return {{rows[0][k], rows[1][k], rows[2][k]}};
  }
  static RealMatrix identity();
  static RealMatrix of_columns(const RealVector& x, const RealVector& y, const RealVector& z);
};

RealMatrix operator+(const RealMatrix& a, const RealMatrix& b);
RealMatrix operator*(Real factor, const RealMatrix& a);
RealMatrix operator*(const RealMatrix& a, const RealMatrix& b);
RealVector operator*(const RealMatrix& a, const RealVector& v);
RealMatrix transposed(const RealMatrix& a);

/// A frame in another one: point = R point' + p.
struct RigidPose {
  RealMatrix R = RealMatrix::identity();
  RealVector p{};
};

RigidPose operator*(const RigidPose& a, const RigidPose& b);
RealVector operator*(const RigidPose& a, const RealVector& point);
RigidPose inverse(const RigidPose& a);

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

RealMatrix turn_x(Real angle);
RealMatrix turn_y(Real angle);
RealMatrix turn_z(Real angle);
/// About a unit vector; Rodrigues' formula.
RealMatrix turn_about(const RealVector& axis, Real angle);
/// Fixed axes x, y, z as URDF has them: Rz(yaw) Ry(pitch) Rx(roll).
RealMatrix turn_rpy(const RealVector& rpy);
/// Of a quaternion w x y z of any length but 0.
RealMatrix turn_quaternion(const std::array<Real, 4>& wxyz);

/// m (p.p 1 - p p^T): what the moments about a point at -p from the centre of mass have more.
RealMatrix parallel_axes(Real mass, const RealVector& p);

/// R A R^T
RealMatrix turned(const RealMatrix& R, const RealMatrix& A);

/// Eigenvalues of a symmetric matrix in rising order; by Jacobi's rotations.
/// @param axes  null, or where their unit vectors go, as columns of a rotation
RealVector principal_moments(const RealMatrix& A, RealMatrix* axes = nullptr);

}  // namespace dyngen
