// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulate/simulated_gears.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/simulation/twisting_effects.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Twist sum_of(const std::vector<EffectInstance>& effects, double load) {
  Twist sum;
  for (const EffectInstance& effect : effects) {
    const Twist own = twist_of(effect, load);
    sum.value += own.value;
    sum.slope += own.slope;
  }
  return sum;
}

bool never_twists(const std::vector<EffectInstance>& effects) {
  const auto no_twist = [&](double load) { return sum_of(effects, load).value == 0; };
  constexpr double kLoads[] = {-1e4, -100, -1, -0.01, 0.01, 1, 100, 1e4};
  return std::all_of(std::begin(kLoads), std::end(kLoads), no_twist);
}

}  // namespace

std::vector<ElasticJoint> elastic_joints(
    const RobotFile& file, const std::vector<EffectInstance>& effects,
    const std::vector<std::size_t>& rows, const VectorXd& rotor,
    const std::function<void(const double* q, double* M)>& mass_matrix,
    std::vector<std::string>& remarks) {
  Diagnostics diagnostics(file.file_name, file.source_text);
  std::map<int, std::vector<std::size_t>> of_joint;
  for (std::size_t i = 0; i < effects.size(); ++i) of_joint[effects[i].joint].push_back(i);
  const Index n = rotor.size();
  const VectorXd zero = VectorXd::Zero(n);
  Eigen::MatrixXd M(n, n);
  if (!effects.empty()) mass_matrix(zero.data(), M.data());
  std::vector<ElasticJoint> joints;
  for (const auto& [joint, places] : of_joint) {
    std::vector<EffectInstance> own;
    for (const std::size_t place : places) own.push_back(effects[place]);
    if (never_twists(own)) continue;
    const EffectRow& row = file.effects[rows[places.front()]];
    const auto refuse = [&](const std::string& found, const std::string& expected) {
      diagnostics.error(row.position, static_cast<int>(row.name.size()),
                        fmt::format("effect '{}' cannot be simulated: {}", row.name, found),
                        expected);
    };
    const double softness = sum_of(own, 0).slope;
    if (!(softness > 0) || !std::isfinite(softness)) {
      refuse(fmt::format("under a small load the gear twists by {:.6g} per torque", softness),
             "expected a positive number");
      continue;
    }
    const double links = M(joint, joint) - rotor[joint];
    if (!(rotor[joint] > 0)) {
      refuse(fmt::format("'IA' of joint {} is {:.6g}", own.front().link, rotor[joint]),
             "expected a positive rotor inertia, since the drive turns apart from its link");
      continue;
    }
    if (!(links > 1e-12 * rotor[joint])) {
      refuse(fmt::format("the links that joint {} moves have the inertia {:.6g} without the rotor",
                         own.front().link, links),
             "expected a positive one, since they swing apart from the drive");
      continue;
    }
    // the stiffness at which drive and link swing against each other at kFastestGear
    const double fastest = 2 * std::numbers::pi * kFastestGear;
    const double stiffest = fastest * fastest / (1 / rotor[joint] + 1 / links);
    if (softness * stiffest <= 1) {
      remarks.push_back(fmt::format(
          "the gear of joint {} is rigid in the simulation: drive and link would swing against "
          "each other at {:.3g} kHz",
          own.front().link, 1e-3 * kFastestGear / std::sqrt(softness * stiffest)));
      continue;
    }
    const double floor = std::max(softness / kStiffestGear, 1 / stiffest);
    joints.push_back({joint, rotor[joint], links,
                      JointSpring([own](double load) { return sum_of(own, load); }, floor)});
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
  return joints;
}

}  // namespace dyngen::runtime
