// SPDX-License-Identifier: MIT
#include "runtime/control/controller.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

void check_model(const ControlModel& model, const ControllerOptions& options) {
  const auto need = [&](bool there, const char* function) {
    if (there) return;
    throw std::invalid_argument(fmt::format("Controller: the law {} needs the model's function {}",
                                            law_name(options.law), function));
  };
  if (model.joints < 1) {
    throw std::invalid_argument(
        fmt::format("Controller: the model has {} joints, expected 1 or more", model.joints));
  }
  if (options.law == ControlLaw::kGravity) need(static_cast<bool>(model.gravity), "gravity");
  if (options.law == ControlLaw::kFeedforward || options.law == ControlLaw::kComputedTorque) {
    need(static_cast<bool>(model.rigid), "rigid");
  }
  if (options.friction) need(static_cast<bool>(model.friction), "friction");
}

}  // namespace

std::string law_name(ControlLaw law) {
  switch (law) {
    case ControlLaw::kPd:
      return "pd";
    case ControlLaw::kGravity:
      return "gravity";
    case ControlLaw::kFeedforward:
      return "ff";
    case ControlLaw::kComputedTorque:
      return "ct";
  }
  return "";
}

void ControllerOptions::validate(int joints) const {
  gains.validate(joints);
  if (friction && law == ControlLaw::kPd) {
    throw std::invalid_argument(
        "Controller: friction compensation belongs to a law with a model, found pd");
  }
  const auto positive = [joints](const char* name, const Eigen::VectorXd& values) {
    if (values.size() == 0) return;
    if (values.size() != joints || !(values.array() > 0).all()) {
      throw std::invalid_argument(
          fmt::format("Controller: {} has {} values, expected {} positive "
                      "ones",
                      name, values.size(), joints));
    }
  };
  positive("friction_band", friction_band);
  positive("torque_limit", torque_limit);
}

Controller::Controller(ControlModel model, ControllerOptions options)
    : model_(std::move(model)), options_(std::move(options)), scratch_(model_.joints) {
  check_model(model_, options_);
  options_.validate(model_.joints);
  if (options_.friction) {
    if (options_.friction_band.size() == 0) {
      options_.friction_band =
          Eigen::VectorXd::Constant(model_.joints, ControllerOptions::kDefaultBand);
    }
    friction_.emplace(model_, options_.friction_band);
  }
}

/// result = kp e + kd e'
void Controller::feedback(const ControlInput& input, double* result) const noexcept {
  for (Index j = 0; j < scratch_.size(); ++j) {
    result[j] = options_.gains.kp[j] * (input.q_ref[j] - input.q[j]) +
                options_.gains.kd[j] * (input.dq_ref[j] - input.dq[j]);
  }
}

int Controller::step(const ControlInput& input, double* tau) noexcept {
  const Index n = scratch_.size();
  switch (options_.law) {
    case ControlLaw::kPd:
      feedback(input, tau);
      break;
    case ControlLaw::kGravity:
      feedback(input, scratch_.data());
      model_.gravity(input.q, tau);
      for (Index j = 0; j < n; ++j) tau[j] += scratch_[j];
      break;
    case ControlLaw::kFeedforward:
      feedback(input, scratch_.data());
      model_.rigid(input.q_ref, input.dq_ref, input.ddq_ref, tau);
      for (Index j = 0; j < n; ++j) tau[j] += scratch_[j];
      break;
    case ControlLaw::kComputedTorque:
      feedback(input, scratch_.data());
      for (Index j = 0; j < n; ++j) scratch_[j] += input.ddq_ref[j];
      model_.rigid(input.q, input.dq, scratch_.data(), tau);
      break;
  }
  if (friction_) {
    friction_->add(
        options_.friction_velocity == FrictionVelocity::kReference ? input.dq_ref : input.dq, tau);
  }
  int saturated = 0;
  for (Index j = 0; j < options_.torque_limit.size(); ++j) {
    const double limit = options_.torque_limit[j];
    saturated += static_cast<int>(tau[j] > limit || tau[j] < -limit);
    if (tau[j] > limit) tau[j] = limit;
    if (tau[j] < -limit) tau[j] = -limit;
  }
  return saturated;
}

}  // namespace dyngen::runtime
