// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulate/simulated_loop.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

ControlLaw law_of(const std::string& name) {
  for (const ControlLaw law : {ControlLaw::kPd, ControlLaw::kGravity, ControlLaw::kFeedforward}) {
    if (law_name(law) == name) return law;
  }
  return ControlLaw::kComputedTorque;
}

VectorXd inertia_at(const SimulatedRobot& robot, const VectorXd& q) {
  VectorXd inertia = mass_matrix_of(robot, q).diagonal();
  for (Index j = 0; j < inertia.size(); ++j) {
    if (inertia[j] > 0) continue;
    throw std::invalid_argument(
        fmt::format("{}: the inertia about joint {} is {}, expected a positive one: gains of pd, "
                    "gravity and ff come from it",
                    robot.name, j + 1, inertia[j]));
  }
  return inertia;
}

}  // namespace

VectorXd per_joint(const char* option, const std::vector<double>& values, int joints) {
  if (values.size() == 1) return VectorXd::Constant(joints, values[0]);
  if (values.size() != static_cast<std::size_t>(joints)) {
    throw std::invalid_argument(fmt::format("{}: found {} values, expected 1 or {}, one a joint",
                                            option, values.size(), joints));
  }
  return Eigen::Map<const VectorXd>(values.data(), joints);
}

Eigen::MatrixXd mass_matrix_of(const SimulatedRobot& robot, const VectorXd& q) {
  Eigen::MatrixXd M(robot.joints(), robot.joints());
  robot.mass_matrix(q.data(), M.data());
  return M;
}

ControllerOptions controller_options(const LoopSettings& settings, const SimulatedRobot& plant,
                                     const VectorXd& posture) {
  ControllerOptions result;
  result.law = law_of(settings.controller);
  result.gains =
      result.law == ControlLaw::kComputedTorque
          ? acceleration_gains(plant.joints(), settings.bandwidth, settings.damping)
          : torque_gains(inertia_at(plant, posture), settings.bandwidth, settings.damping);
  const bool has_motion_model =
      result.law == ControlLaw::kFeedforward || result.law == ControlLaw::kComputedTorque;
  result.friction = settings.friction == "on" || (settings.friction == "auto" && has_motion_model);
  if (settings.friction_velocity == "measured") {
    result.friction_velocity = FrictionVelocity::kMeasured;
  }
  result.friction_band = per_joint("--friction-band", settings.friction_band, plant.joints());
  return result;
}

VectorXd torque_limit_of(const LoopSettings& settings, const SimulatedRobot& plant) {
  if (settings.saturate == "on") return plant.torque_limit;
  return VectorXd::Constant(plant.joints(), std::numeric_limits<double>::infinity());
}

ClosedLoopOptions loop_options(const LoopSettings& settings, int joints) {
  ClosedLoopOptions loop;
  loop.continuous = settings.rate == 0;
  loop.rate = loop.continuous ? LoopSettings::kContinuousRecordRate : settings.rate;
  loop.delay = settings.delay;
  loop.encoder_step = per_joint("--encoder", settings.encoder, joints);
  loop.encoder_noise = settings.encoder_noise;
  loop.velocity_cutoff_hz = settings.velocity_cutoff;
  loop.integration.tolerance = settings.tolerance;
  return loop;
}

}  // namespace dyngen::runtime
