// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/views/division.h"

#include <Eigen/Core>
#include <algorithm>

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kParts = 5;
constexpr double kMoves = 0.01;  // of a joint's largest speed
constexpr double kEnough = 0.5;  // of the time for which joints move in the whole recording

/// How often each joint moves in every part of a recording. @return (joints x parts) samples
Eigen::ArrayXXd moving(const MotionSource& source) {
  Eigen::ArrayXXd counts = Eigen::ArrayXXd::Zero(source.joints(), kParts);
  for (int part = 0; part < kParts; ++part) {
    const double from = static_cast<double>(part) / kParts;
    part_of(source, from, from + 1.0 / kParts).pieces([&](const StreamPiece& piece) {
      for (Index j = 0; j < counts.rows(); ++j) {
        const auto moves = piece.motion.dq.col(j).array().abs() > kMoves * source.fastest[j];
        counts(j, part) += static_cast<double>(moves.count());
      }
    });
  }
  return counts;
}

int held_part(const MotionSource& source) {
  const Eigen::ArrayXXd counts = moving(source);
  const ArrayXd mean = counts.rowwise().sum() / kParts;
  for (int part = kParts - 1; part >= 0; --part) {
    if ((counts.col(part) >= kEnough * mean).all()) return part;
  }
  return kParts - 1;
}

}  // namespace

Division divided(const std::vector<MotionSource>& recordings) {
  Division division;
  for (std::size_t place = 0; place < recordings.size(); ++place) {
    const MotionSource& source = recordings[place];
    const auto fit = [&](double begin, double end) {
      division.train.push_back(part_of(source, begin, end));
      division.origins.push_back(place);
    };
    const int part = held_part(source);
    const double from = static_cast<double>(part) / kParts, to = from + 1.0 / kParts;
    if (part > 0) fit(0, from);
    if (part < kParts - 1) fit(to, 1);
    division.heldout.push_back(part_of(source, from, to));
  }
  return division;
}

}  // namespace dyngen::runtime
