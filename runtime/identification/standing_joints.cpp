// SPDX-License-Identifier: MIT
#include "runtime/identification/standing_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "runtime/identification/motion_rows.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// (n) largest speeds over all recordings, rad/s or m/s.
VectorXd fastest_of(const std::vector<MotionSource>& sources, Index joints) {
  VectorXd fastest = VectorXd::Zero(joints);
  for (const MotionSource& source : sources) {
    if (source.joints() == joints) fastest = fastest.cwiseMax(source.fastest);
  }
  return fastest;
}

/// (n) that of the fastest joint of the same kind.
VectorXd fastest_of_kind(const VectorXd& fastest, const std::vector<bool>& revolute) {
  VectorXd most = VectorXd::Zero(fastest.size());
  for (Index j = 0; j < most.size(); ++j) {
    for (Index k = 0; k < most.size(); ++k) {
      const bool alike =
          revolute[static_cast<std::size_t>(j)] == revolute[static_cast<std::size_t>(k)];
      if (alike) most[j] = std::max(most[j], fastest[k]);
    }
  }
  return most;
}

/// Mean positions of every run. @return (runs x n)
MatrixXd mean_postures(const MotionSource& source) {
  MatrixXd sums(0, source.joints());
  std::vector<double> samples;
  source.pieces([&](const StreamPiece& piece) {
    if (!piece.continues_run || samples.empty()) {
      sums.conservativeResize(sums.rows() + 1, Eigen::NoChange);
      sums.row(sums.rows() - 1).setZero();
      samples.push_back(0);
    }
    sums.row(sums.rows() - 1) += piece.motion.q.colwise().sum();
    samples.back() += static_cast<double>(piece.motion.samples());
  });
  for (Index run = 0; run < sums.rows(); ++run) {
    sums.row(run) /= std::max(samples[static_cast<std::size_t>(run)], 1.0);
  }
  return sums;
}

/// One joint state of a recording, its joints still.
MotionSource made_still(const MotionSource& source, const StandingJoints& standing) {
  auto postures = std::make_shared<MatrixXd>();
  MotionSource still = with_pieces(
      source, [source, standing, postures](const std::function<void(const StreamPiece&)>& visit) {
        if (postures->size() == 0) *postures = mean_postures(source);
        Index run = -1;
        source.pieces([&](const StreamPiece& piece) {
          if (!piece.continues_run || run < 0) ++run;
          StreamPiece held = piece;
          for (Index j = 0; j < held.motion.joints(); ++j) {
            if (!standing[static_cast<std::size_t>(j)]) continue;
            held.motion.q.col(j).setConstant((*postures)(run, j));
            held.motion.dq.col(j).setZero();
            held.motion.ddq.col(j).setZero();
          }
          visit(held);
        });
      });
  for (Index j = 0; j < still.fastest.size(); ++j) {
    if (standing[static_cast<std::size_t>(j)]) still.fastest[j] = still.position_noise[j] = 0;
  }
  return still;
}

std::string standing_sentence(const StandingJoints& standing) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < standing.size(); ++j) {
    if (standing[j]) joints.push_back(j + 1);
  }
  const bool one = joints.size() == 1;
  return fmt::format(
      "joint{} {} stand{} throughout: taken as still at {} mean position, no "
      "equations",
      one ? "" : "s", fmt::join(joints, ", "), one ? "s" : "", one ? "its" : "their");
}

}  // namespace

std::vector<StandingJoints> standing_joints(const std::vector<MotionSource>& fitted,
                                            const std::vector<bool>& revolute,
                                            const std::vector<MotionSource>& looked_at) {
  const auto joints = static_cast<Index>(revolute.size());
  const VectorXd least =
      kStandstillPart *
      fastest_of_kind(fastest_of(fitted, joints), revolute).cwiseMax(fastest_of(fitted, joints));
  std::vector<StandingJoints> all;
  for (const MotionSource& source : looked_at) {
    StandingJoints own(revolute.size(), false);
    for (Index j = 0; j < joints && source.joints() == joints && !source.condition.stands; ++j) {
      own[static_cast<std::size_t>(j)] = source.fastest[j] < least[j];
    }
    all.push_back(std::move(own));
  }
  return all;
}

MotionSource with_joints_still(const MotionSource& source, const StandingJoints& standing) {
  if (standing.size() != static_cast<std::size_t>(source.joints())) {
    throw std::invalid_argument(fmt::format("with_joints_still(): {} joints, {} has {}",
                                            standing.size(), source.name, source.joints()));
  }
  if (std::none_of(standing.begin(), standing.end(), [](bool stands) { return stands; })) {
    return source;
  }
  return made_of(source, [standing](const MotionSource& state) {
    MotionSource still = made_still(state, standing);
    std::vector<std::string>& messages = still.condition.messages;
    std::string sentence = standing_sentence(standing);
    if (std::find(messages.begin(), messages.end(), sentence) == messages.end()) {
      messages.push_back(std::move(sentence));
    }
    return still;
  });
}

void hold_standing_joints(const std::vector<bool>& revolute, std::vector<MotionSource>& fitted,
                          const std::vector<std::vector<MotionSource>*>& others) {
  const std::vector<MotionSource> moving = fitted;
  const auto hold = [&](std::vector<MotionSource>& sources) {
    const std::vector<StandingJoints> standing = standing_joints(moving, revolute, sources);
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].joints() != static_cast<int>(revolute.size())) continue;
      sources[i] = with_joints_still(sources[i], standing[i]);
    }
  };
  hold(fitted);
  for (std::vector<MotionSource>* sources : others) hold(*sources);
}

}  // namespace dyngen::runtime
