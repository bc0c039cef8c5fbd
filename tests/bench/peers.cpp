// SPDX-License-Identifier: MIT
#include "tests/bench/peers.h"

namespace dyngen::bench {

CentralInertia central_inertia(const test::NumericJoint& joint) {
  const auto& [XX, XY, XZ, YY, YZ, ZZ, MX, MY, MZ, M] = joint.inertial;
  CentralInertia link{M, {}, XX, XY, XZ, YY, YZ, ZZ};
  if (M == 0) return link;  // only a moment of inertia is given: it needs no centre
  link.com = {MX / M, MY / M, MZ / M};
  const auto& [x, y, z] = link.com;  // parallel axes: J_com = J_O - M (|c|^2 1 - c c')
  link.xx -= M * (y * y + z * z);
  link.yy -= M * (x * x + z * z);
  link.zz -= M * (x * x + y * y);
  link.xy += M * x * y;
  link.xz += M * x * z;
  link.yz += M * y * z;
  return link;
}

}  // namespace dyngen::bench
