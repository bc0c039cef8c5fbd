// SPDX-License-Identifier: MIT
#include "tests/runtime/diagnosis/changes/compared_arm.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "runtime/effects/effect_fit.h"

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace runtime;

namespace {

constexpr double kFirstLink = 0.5;  // m, its length

/// Base parameters that one unit of a load's parameter adds.
VectorXd unit_load(int link, const std::string& name) {
  VectorXd beta = VectorXd::Zero(13);
  const Index zz = link == 1 ? 0 : 3;
  if (name == "ZZ") beta[zz] = 1;
  if (name == "MX") beta[zz + 1] = 1;
  if (name == "MY") beta[zz + 2] = 1;
  if (name == "M" && link == 2) {
    beta[0] = kFirstLink * kFirstLink;
    beta[1] = kFirstLink;
  }
  return beta;
}

std::vector<MotionSource> sessions_of(const ComparedArm& arm, bool later, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<MotionSource> sources;
  const int count = later ? arm.after : arm.before;
  for (int s = 0; s < count; ++s) {
    VectorXd beta = planar_arm_values();
    for (Index j = 0; j < 2; ++j) {
      const double friction = beta[7 + j];
      beta[7 + j] *= 1 + arm.scatter * normal(random);
      beta[9 + j] *= 1 + arm.scatter * normal(random);
      beta[11 + j] += arm.scatter * friction * normal(random);
    }
    if (later) beta += arm.change;
    const double phase = 0.37 * static_cast<double>(s + (later ? 7 : 0)) + 0.01 * arm.seed;
    const auto seed = static_cast<unsigned>(random());
    std::vector<EffectInstance> effects = arm.always;
    if (later) effects.insert(effects.end(), arm.effects.begin(), arm.effects.end());
    sources.push_back(
        measured({sines(20, 0.01, phase)}, beta, effects, arm.noise, arm.coefficient, seed)
            .front());
  }
  return sources;
}

}  // namespace

LinearModel arm_with_links() {
  LinearModel model = planar_arm();
  for (std::size_t i = 0; i < 6; ++i) model.parameters[i].link = i < 3 ? 1 : 2;
  return model;
}

EffectRobot arm_with_loads() {
  EffectRobot robot;
  robot.tangents = [](const TangentKey& wanted, const JointMotion& motion, const VectorXd&,
                      double) -> TangentColumns {
    const int link = wanted.second == 1 ? 1 : 2;
    const LinearModel model = planar_arm();
    const VectorXd unit = unit_load(link, wanted.first.substr(std::string("payload_").size()));
    return {{wanted, model.torque(motion.q, motion.dq, motion.ddq, unit)}};
  };
  return robot;
}

VectorXd load_of(int link, double mass, double x, double y, double inertia) {
  return mass * (unit_load(link, "M") + x * unit_load(link, "MX") + y * unit_load(link, "MY")) +
         (inertia + mass * (x * x + y * y)) * unit_load(link, "ZZ");
}

EffectLaw gain_law() {
  EffectLaw law =
      algebraic_law("torque_gain", {"torque"}, {{"gain", EffectRole::kLinear, -0.9, 10, 0, -0.05}},
                    [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; });
  law.kind = EffectKind::kTangent;
  return law;
}

std::vector<EffectInstance> arm_effects() {
  std::vector<EffectInstance> effects;
  for (const EffectLaw& law : {gain_law(), spring_law(), coulomb_asymmetry_law()}) {
    for (const int joint : {0, 1}) {
      EffectInstance effect = unknown(law, joint);
      effect.link = joint + 1;
      effects.push_back(std::move(effect));
    }
  }
  return effects;
}

ChangesSince changes_of(const ComparedArm& arm) {
  std::mt19937_64 random(arm.seed);
  DiagnosisInput input;
  input.model = arm_with_links();
  input.robot = arm_with_loads();
  input.hypotheses = arm_effects();
  input.loads = {{0, 1}, {-1, 0}};
  const auto equations = [&](bool later) {
    return effect_recordings(input.model, input.robot, sessions_of(arm, later, random), {1, -1});
  };
  const EffectRecordings reference = equations(false), later = equations(true);
  CompetitionResult result;
  result.fit = result.base = fit_effects(later, {});
  RunResiduals residuals;
  for (const EffectRun& run : later.runs) {
    residuals.push_back(residual(run.rows, result.fit.point.beta));
  }
  result.noise = torque_noise_model(later, residuals, std::vector<double>(later.runs.size()), true);
  std::vector<Hypothesis> hypotheses;
  for (const EffectInstance& effect : input.hypotheses) {
    hypotheses.push_back(
        hypothesis_of(effect, scales_of(later, result.fit.point.beta, effect.joint)));
    NamedResult named;
    named.hypothesis = hypotheses.size() - 1;
    named.part_left = 1;  // all of them compete, absorbed by the model or not
    named.typical = VectorXd::Ones(1);
    result.first.named.push_back(std::move(named));
  }
  return changes_since({reference, later, {}}, input, hypotheses, result, 0.002, {});
}

std::vector<std::string> names_of(const ChangesSince& changes) {
  std::vector<std::string> names;
  for (const Finding& finding : changes.findings) {
    if (finding.probability < 0.5) continue;
    names.push_back(fmt::format("{} {}", finding.effect.law.family, finding.effect.joint + 1));
  }
  return names;
}

}  // namespace dyngen::test
