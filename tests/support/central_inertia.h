// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A link about its centre of mass, in the axes of its frame: what other libraries take.
struct CentralInertia {
  double mass = 0;
  std::array<double, 3> com{};
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

/// Parallel axes: J_com = J_O - M (|c|^2 1 - c c'). A link without mass has only a moment of
/// inertia, which needs no centre; its first moments are left out (see is_body()).
inline CentralInertia central_inertia(const NumericJoint& joint) {
  const auto& [XX, XY, XZ, YY, YZ, ZZ, MX, MY, MZ, M] = joint.inertial;
  CentralInertia link{M, {}, XX, XY, XZ, YY, YZ, ZZ};
  if (M == 0) return link;
  link.com = {MX / M, MY / M, MZ / M};
  const auto& [x, y, z] = link.com;
  link.xx -= M * (y * y + z * z);
  link.yy -= M * (x * x + z * z);
  link.zz -= M * (x * x + y * y);
  link.xy += M * x * y;
  link.xz += M * x * z;
  link.yz += M * y * z;
  return link;
}

/// False for first moments without a mass, as base parameters may have: no centre of mass says it.
inline bool is_body(const NumericJoint& joint) {
  const auto& p = joint.inertial;
  return p[9] > 0 || (p[9] == 0 && p[6] == 0 && p[7] == 0 && p[8] == 0);
}

}  // namespace dyngen::test
