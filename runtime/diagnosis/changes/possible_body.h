// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// The ten inertial parameters of a body, in the order of chi.h: XX XY XZ YY YZ ZZ MX MY MZ M.
inline constexpr int kBodyParameters = 10;
using BodyVector = Eigen::Matrix<double, kBodyParameters, 1>;
using BodyMatrix = Eigen::Matrix<double, kBodyParameters, kBodyParameters>;

/// What the equations say of a body: chi-square is x'Gx - 2 b'x, and a constant.
struct BodyEvidence {
  BodyMatrix G = BodyMatrix::Zero();
  BodyVector b = BodyVector::Zero();

  [[nodiscard]] double chi_square(const BodyVector& x) const { return x.dot(G * x) - 2 * b.dot(x); }
};

/// The body that fits best of those that can exist, and of those that are taken away: +-x of a
/// pseudo-inertia matrix without negative eigenvalues.
/// Source: Wensing, Kim and Slotine, "Linear matrix inequalities for physically consistent inertial
/// parameter identification", RA-L 2018.
struct PossibleBody {
  BodyVector parameters = BodyVector::Zero();
  double worse = 0;  ///< chi-square above that of any ten numbers
};
PossibleBody possible_body(const BodyEvidence& evidence);

/// The point of mass that fits best, m at c: tensor m (c'c 1 - cc'), first moment m c.
struct PointMass {
  double mass = 0;                                  ///< kg; negative: one that is taken away
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< m, in the link's frame

  [[nodiscard]] BodyVector parameters() const;
  /// Derivatives by mass and place. @return (10 x 4)
  [[nodiscard]] Eigen::Matrix<double, kBodyParameters, 4> tangents() const;
};
/// @param start  a body near it
PointMass point_mass(const BodyEvidence& evidence, const BodyVector& start);

}  // namespace dyngen::runtime
