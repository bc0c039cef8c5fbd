// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/imitation.h"

#include <algorithm>

namespace dyngen::runtime {
Imitation imitation(const EvidenceSystem& system, const JointColumns& torque,
                    const JointColumns& other) {
  const Products products = system.products(side_by_side({torque, other}), false);
  const Eigen::Index k = other.columns();
  Products as_rest;
  as_rest.whole = products.whole.bottomRightCorner(k, k);
  as_rest.left = products.left.bottomRightCorner(k, k);
  as_rest.rest = products.left.bottomLeftCorner(k, 1);
  const double whole = products.left(0, 0);
  return {std::max(0.0, whole - score_of(as_rest, false).delta_chi2), whole};
}

}  // namespace dyngen::runtime
