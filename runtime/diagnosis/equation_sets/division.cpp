// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/division.h"

#include <Eigen/Core>
#include <algorithm>

#include "runtime/identification/motion_rows.h"

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kDivisionParts = 5;

/// How often each joint moves in every part of a recording. @return (joints x parts) samples
Eigen::ArrayXXd moving(const MotionSource& source) {
  Eigen::ArrayXXd counts = Eigen::ArrayXXd::Zero(source.joints(), kDivisionParts);
  for (int part = 0; part < kDivisionParts; ++part) {
    const double from = static_cast<double>(part) / kDivisionParts;
    part_of(source, from, from + 1.0 / kDivisionParts).pieces([&](const StreamPiece& piece) {
      for (Index j = 0; j < counts.rows(); ++j) {
        const auto moves =
            piece.motion.dq.col(j).array().abs() > kStandstillPart * source.fastest[j];
        counts(j, part) += static_cast<double>(moves.count());
      }
    });
  }
  return counts;
}

int held_part(const MotionSource& source, const EquationRules& rules) {
  const Eigen::ArrayXXd counts = moving(source);
  const ArrayXd mean = counts.rowwise().sum() / kDivisionParts;
  for (int part = kDivisionParts - 1; part >= 0; --part) {
    if ((counts.col(part) >= rules.heldout_motion.value * mean).all()) return part;
  }
  return kDivisionParts - 1;
}

}  // namespace

Division divided(const std::vector<MotionSource>& recordings, const EquationRules& rules) {
  Division division;
  for (std::size_t place = 0; place < recordings.size(); ++place) {
    const MotionSource& source = recordings[place];
    const auto fit = [&](double begin, double end) {
      division.train.push_back(part_of(source, begin, end));
      division.origins.push_back(place);
    };
    const int part = held_part(source, rules);
    const double from = static_cast<double>(part) / kDivisionParts,
                 to = from + 1.0 / kDivisionParts;
    if (part > 0) fit(0, from);
    if (part < kDivisionParts - 1) fit(to, 1);
    division.heldout.push_back(part_of(source, from, to));
  }
  return division;
}

}  // namespace dyngen::runtime
