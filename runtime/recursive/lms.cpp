// SPDX-License-Identifier: MIT
#include "runtime/recursive/lms.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/recursive/sample.h"

namespace dyngen::runtime {

void validate_gains(const char* caller, int joints, const Eigen::VectorXd& gain,
                    const Eigen::VectorXd& joint_weights, const Eigen::VectorXd& start) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(fmt::format("{}: {}", caller, what));
  };
  if (joints < 1) fail(fmt::format("joints = {}, expected 1 or more", joints));
  if (gain.size() == 0 || !gain.allFinite() || gain.minCoeff() < 0 || gain.maxCoeff() <= 0) {
    fail("gain needs a value >= 0 for every parameter, and one > 0");
  }
  if (joint_weights.size() != 0 &&
      (joint_weights.size() != joints || !joint_weights.allFinite() ||
       joint_weights.minCoeff() < 0 || joint_weights.maxCoeff() <= 0)) {
    fail(fmt::format("joint_weights has {} values, expected {} values >= 0, one > 0 (or none)",
                     joint_weights.size(), joints));
  }
  if (start.size() != 0 && (start.size() != gain.size() || !start.allFinite())) {
    fail(fmt::format("start has {} values, expected {} finite ones (or none)", start.size(),
                     gain.size()));
  }
}

void LmsOptions::validate(int joints) const {
  validate_gains("LmsOptions", joints, gain, joint_weights, start);
  if (normalised && !(step > 0 && step < 2)) {
    throw std::invalid_argument(
        fmt::format("LmsOptions: step = {}, expected between 0 and 2", step));
  }
  if (!(floor >= 0 && std::isfinite(floor))) {
    throw std::invalid_argument(fmt::format("LmsOptions: floor = {}, expected >= 0", floor));
  }
}

Lms::Lms(int joints, LmsOptions options) : options_(std::move(options)) {
  options_.validate(joints);
  const Eigen::Index nb = options_.gain.size();
  if (options_.joint_weights.size() == 0) options_.joint_weights.setOnes(joints);
  if (options_.start.size() == 0) options_.start.setZero(nb);
  beta_ = options_.start;
  increment_.setZero(nb);
  candidate_.setZero(nb);
}

bool Lms::update(const double* Y, const double* tau) noexcept {
  const Eigen::Index n = options_.joint_weights.size(), nb = beta_.size();
  if (!usable_sample(Y, tau, n, nb)) return false;
  const RegressorMap H(Y, n, nb);
  increment_.setZero();
  double trace = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double weight = options_.joint_weights[j];
    increment_ += (weight * (tau[j] - H.row(j).dot(beta_))) * H.row(j).transpose();
    if (options_.normalised) {
      trace += weight * (H.row(j).array().square() * options_.gain.transpose().array()).sum();
    }
  }
  double step = 1;
  if (options_.normalised) {
    const double divisor = options_.floor + trace;
    if (!(divisor > 0)) return false;
    step = options_.step / divisor;
  }
  candidate_ = beta_ + step * options_.gain.cwiseProduct(increment_);
  if (!candidate_.allFinite()) return false;
  beta_.swap(candidate_);
  ++samples_;
  return true;
}

}  // namespace dyngen::runtime
