// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/imitation.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dyngen::runtime {
namespace {

/// Columns of two sets side by side; those of joints that one of them lacks are 0.
JointColumns beside(const JointColumns& a, const JointColumns& b) {
  std::set<int> joints(a.joints.begin(), a.joints.end());
  joints.insert(b.joints.begin(), b.joints.end());
  JointColumns both;
  for (const int joint : joints) {
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero((a.parts.empty() ? b : a).parts.front().rows(),
                                                 a.columns() + b.columns());
    for (std::size_t i = 0; i < a.joints.size(); ++i) {
      if (a.joints[i] == joint) part.leftCols(a.columns()) = a.parts[i];
    }
    for (std::size_t i = 0; i < b.joints.size(); ++i) {
      if (b.joints[i] == joint) part.rightCols(b.columns()) = b.parts[i];
    }
    both.joints.push_back(joint);
    both.parts.push_back(std::move(part));
  }
  return both;
}

}  // namespace

Imitation imitation(const EvidenceSystem& system, const JointColumns& torque,
                    const JointColumns& other) {
  const Products products = system.products(beside(torque, other), false);
  const Eigen::Index k = other.columns();
  Products as_rest;
  as_rest.whole = products.whole.bottomRightCorner(k, k);
  as_rest.left = products.left.bottomRightCorner(k, k);
  as_rest.rest = products.left.bottomLeftCorner(k, 1);
  const double whole = products.left(0, 0);
  return {std::max(0.0, whole - score_of(as_rest, false).squares), whole};
}

}  // namespace dyngen::runtime
