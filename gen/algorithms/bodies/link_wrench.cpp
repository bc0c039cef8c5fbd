// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/bodies/link_wrench.h"

#include <fmt/format.h>

namespace dyngen {
namespace {

using GiNaC::ex;

/// J WP + W x (J W), written with U:
///   N1 = XX WP1 + (ZZ - YY) W2 W3 + XZ U21 - XY U31 + YZ (W2^2 - W3^2), and cyclically.
Vector3 moment_of_tensor(Trace& trace, const std::string& mark, int j, const Tensor& tensor,
                         const LinkMotion& motion) {
  const auto& [XX, XY, XZ, YY, YZ, ZZ] = tensor;
  const Vector3& WP = motion.WP;
  const Vector3& WW = motion.WW;
  const Vector3& D = motion.D;
  const Matrix3& U = motion.U;
  const auto difference = [&](const char* name, const ex& a, const ex& b) {
    return trace.assign(fmt::format("{}{}_{}", mark, name, j), a - b);
  };
  const ex zy = difference("ZmY", ZZ, YY), xz = difference("XmZ", XX, ZZ),
           yx = difference("YmX", YY, XX);
  return {XX * WP[0] + zy * WW[0] + XZ * U[1][0] - XY * U[2][0] + YZ * D[0],
          YY * WP[1] + xz * WW[1] + XY * U[2][1] - YZ * U[0][1] + XZ * D[1],
          ZZ * WP[2] + yx * WW[2] + YZ * U[0][2] - XZ * U[1][2] + XY * D[2]};
}

/// The same with the Euler tensor K: the integral of r x (U r) dm is made of the elements of
/// U K - (U K)^T, since K is the integral of r r^T dm.
Vector3 moment_of_euler_tensor(const Tensor& tensor, const LinkMotion& motion) {
  const auto& [XX, XY, XZ, YY, YZ, ZZ] = tensor;
  const Vector3& D = motion.D;
  const Matrix3& U = motion.U;
  return {U[2][0] * XY + U[2][1] * YY - D[0] * YZ - U[1][0] * XZ - U[1][2] * ZZ,
          U[0][1] * YZ + U[0][2] * ZZ - D[1] * XZ - U[2][0] * XX - U[2][1] * XY,
          U[1][0] * XX + U[1][2] * XZ - D[2] * XY - U[0][1] * YY - U[0][2] * YZ};
}

}  // namespace

Vector3 link_force(const LinkInertia& inertia, const LinkMotion& motion) {
  Vector3 force;
  for (std::size_t k = 0; k < 3; ++k) {
    force[k] = inertia.M * motion.VP[k];
    for (std::size_t i = 0; i < 3; ++i) force[k] += motion.U[k][i] * inertia.MS[i];
  }
  return force;
}

Vector3 link_moment(Trace& trace, const std::string& mark, int link, const LinkInertia& inertia,
                    const LinkMotion& motion) {
  Vector3 moment = inertia.euler_tensor
                       ? moment_of_euler_tensor(inertia.tensor, motion)
                       : moment_of_tensor(trace, mark, link, inertia.tensor, motion);
  const Vector3 lever = cross(inertia.MS, motion.VP);
  for (std::size_t k = 0; k < 3; ++k) moment[k] += lever[k];
  return moment;
}

}  // namespace dyngen
