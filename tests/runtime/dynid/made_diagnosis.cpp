// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/made_diagnosis.h"

#include <limits>

#include "runtime/tools/dynid/effects/effect_laws.h"

namespace dyngen::test {

using namespace runtime;
using Eigen::Vector3d;

const DescribedRobot& made_robot() {
  static const DescribedRobot kRobot = describe_robot(
      DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot", OpenParameters::kAbsentRows);
  return kRobot;
}

EffectInstance made_effect(const std::string& name, int joint, int other,
                           const std::vector<double>& parameters) {
  EffectInstance effect;
  effect.law = effect_law(*EffectCatalogue().find(name));
  effect.joint = joint;
  effect.link = joint + 1;
  effect.other = other;
  effect.parameters = Eigen::Map<const Eigen::VectorXd>(
      parameters.data(), static_cast<Eigen::Index>(parameters.size()));
  return effect;
}

Diagnosis made_diagnosis() {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::kUnexplainedStructure;
  diagnosis.sentence = "two effects explain most of it; something is left on joint 1 <&>";
  diagnosis.condition = {{"run \"1\".csv", {"time base uniform, 500 Hz", "no clipping"}}};
  diagnosis.noise.deviation = Vector3d(0.2, 0.3, 0.1);
  diagnosis.noise.correlation_time = Vector3d(3, 4, 5);
  diagnosis.noise.worth = Vector3d(900, 800, 700);
  diagnosis.noise.how = "from what the last model left: a lower bound";
  for (int j = 0; j < 3; ++j) {
    diagnosis.before.push_back({j, 90.0 - j, 20, "qd" + std::to_string(j + 1)});
    diagnosis.after.push_back({j, j == 0 ? 31.0 : 12.0, 20, "q1"});
  }
  Finding stribeck;
  stribeck.effect = made_effect("stribeck", 1, -1, {13, 0.15, 2});
  stribeck.parameters = {
      {13, 0.25, false, false, true}, {0.15, 0.01, false, false, true}, {2, 0, true, false, true}};
  stribeck.aliases = {"stribeck", "presliding"};
  stribeck.probability = 0.97;
  stribeck.absorbed = 0.625;
  stribeck.where = {"qd2",
                    -0.25,
                    0.25,
                    std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::quiet_NaN(),
                    0.75,
                    false,
                    ""};
  stribeck.evidence = {130, -95, 0.21};
  stribeck.tests = {{"vs <= 0.25*v90", true, "narrow enough", true},
                    {"slow_steady", false, "no <data>", true}};
  stribeck.unusual = {"vs = 0.15 rad/s: unusual, a wider curve is curved viscous friction"};
  stribeck.why = "friction falls as joint 2 begins to slide";
  Finding coupling;
  coupling.effect = made_effect("viscous_coupling", 2, 1, {0.5, 1});
  coupling.parameters = {{0.5, 0.02, false, false, true}, {1, 0, false, true, true}};
  coupling.aliases = {"joint_coupling"};
  coupling.probability = 0.8;
  coupling.where.t_from = 2;
  coupling.where.t_to = 7;
  coupling.why = "joint 3 is dragged by joint 2";
  diagnosis.findings = {stribeck, coupling};
  for (int j = 0; j < 3; ++j) {
    diagnosis.undecidable.push_back(
        {{"torque_offset", "coulomb_asymmetry"}, j, "identical columns on any data"});
  }
  diagnosis.undecidable.push_back({{"payload"}, -1, "the last link's own parameters"});
  diagnosis.unexplained = {{0, {"q1", "qd1"}, 0.4, "smooth over q1, without memory"}};
  diagnosis.certificate = {
      {made_effect("backlash", 0, -1, {}), 0, 0.002},
      {made_effect("viscous_coupling", 0, 1, {}), 0, 0.1},
      {made_effect("time_delay", -1, -1, {}), 0, 0.0005},
      {made_effect("constant_offset", 2, -1, {}), 0, std::numeric_limits<double>::infinity()}};
  diagnosis.certificate[2].effect.link = 0;
  diagnosis.base_parameters = {{"ZZ1R", 1.1, 1.2, 0.02}, {"FS2", 9, 8.1, 0.1}};
  diagnosis.heldout.before = Vector3d(1, 2, 4);
  diagnosis.heldout.after = Vector3d(0.9, 1, 3);
  diagnosis.heldout.floor = Vector3d(0.5, 0.75, std::numeric_limits<double>::quiet_NaN());
  diagnosis.next = {"separate stribeck from presliding on joint 2",
                    "slow both ways",
                    1,
                    {"stribeck", "presliding"}};
  diagnosis.fit.point.beta.resize(made_robot().linear.size());
  for (int i = 0; i < made_robot().linear.size(); ++i) {
    diagnosis.fit.point.beta[i] =
        *made_robot().linear.parameters[static_cast<std::size_t>(i)].value * (1 + 1.0 / (3 + i));
  }
  diagnosis.fit.point.effects = {stribeck.effect, coupling.effect};
  return diagnosis;
}

DiagnosisReport made_report() {
  DiagnosisReport report = diagnosis_report(made_diagnosis(), made_robot(), EffectCatalogue());
  report.recordings = {{"run \"1\".csv", "fitted", 20}, {"run2.csv", "held out", 10}};
  report.false_alarm = 0.01;
  report.seed = 7;
  report.command = "dynid diagnose arm.robot 'run \"1\".csv'";
  report.robot_path = "arm.robot";
  report.json_path = "d.json";
  report.version = "0.1.0";
  report.written = {"report.html"};
  return report;
}

}  // namespace dyngen::test
