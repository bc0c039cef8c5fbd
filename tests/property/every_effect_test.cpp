// SPDX-License-Identifier: MIT
// Each effect in emitted code: against a judge that reads the effect file's tree in plain numbers,
// against the rigid model with friction, and compiled against evaluated.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "tests/support/compiled_model.h"
#include "tests/support/effect_arm.h"
#include "tests/support/effect_judge.h"
#include "tests/support/effect_names.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

/// Sizes of such an arm, for starts and typical values.
double scale(const std::string& name) {
  static const std::map<std::string, double> kScales = {
      {"Fc", 2.5288},    {"Fv", 1.7243},   {"Ia", 0.47588},
      {"v_max", 3},      {"v90", 2},       {"q_range", 3},
      {"tau_max", 30},   {"duration", 20}, {"position_step", 1e-4},
      {"temp_range", 20}};
  return kScales.at(name);
}

/// Start values; where these say "nothing of it", what is typical; where that too, a tenth.
std::map<std::string, double> parameters_of(const EffectFile& effect) {
  std::map<std::string, double> values;
  for (const EffectParameter& parameter : effect.parameters) {
    double value = numeric_value(parameter.start, scale);
    if (value == 0) value = numeric_value(parameter.typical, scale);
    values[parameter.name] = value == 0 && !parameter.min ? 0.1 : value;
  }
  return values;
}

std::string row_of(const EffectFile& effect, const std::map<std::string, double>& values,
                   int joint = 2, int other = 1) {
  std::string row = fmt::format("effect {} joint={}", effect.name, joint);
  if (effect.scope == EffectScope::kPair) row += fmt::format(" other={}", other);
  for (const auto& [name, value] : values) row += fmt::format(" {}={}", name, value);
  return row;
}

std::vector<double> sum(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

class EveryEffect : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!effect_->runs_in_controller()) GTEST_SKIP() << "it does not run in a controller";
    values_ = parameters_of(*effect_);
  }

  /// What the effect's equations may read of a joint and its partner.
  static NumericValues variables(const MotionSample& sample, const std::vector<double>& load,
                                 int joint) {
    return [&sample, &load, joint](const std::string& name) {
      const bool partner = name.ends_with("_other");
      const std::size_t at = partner == (joint == 2) ? 0 : 1;
      const std::string own = partner ? name.substr(0, name.size() - 6) : name;
      if (own == "q") return sample.q[at];
      if (own == "qd") return sample.dq[at];
      if (own == "qdd") return sample.ddq[at];
      if (own == "tau_load") return load[at];
      if (own == "sign_qd") return sample.dq[at] > 0 ? 1.0 : sample.dq[at] < 0 ? -1.0 : 0.0;
      if (own == "Fc") return at == 0 ? 2.911 : 2.5288;
      if (own == "Fv") return at == 0 ? 0.7729 : 1.7243;
      return at == 0 ? 0.67065 : 0.47588;  // Ia
    };
  }

  /// At one of the two joints; rotor inertia of joint 1 is grouped with base parameters.
  void expect_torque(int joint, const GeneratorOptions& options) {
    const RobotModel model = arm_with(row_of(*effect_, values_, joint, 3 - joint));
    const EvaluatedModel evaluated(model, options);
    EffectJudge judge(*effect_, [&](const std::string& name) { return values_.at(name); });
    EffectState state = evaluated.new_state(kArmPeriod);
    RelativeError error;
    double step = 0;
    const std::size_t at = static_cast<std::size_t>(joint - 1);
    for (const MotionSample& sample : arm_motion()) {
      std::vector<double> load = evaluated.call("id_rigid", sample);
      load[0] -= 0.67065 * sample.ddq[0];  // rotor inertias of the file
      load[1] -= 0.47588 * sample.ddq[1];
      const std::vector<double> own = judge.torque(variables(sample, load, joint), step);
      const std::vector<double> torque = evaluated_call(evaluated, "effects", sample, state);
      error.add(torque[at], own[0]);
      if (own.size() > 1) {
        error.add(torque[1 - at], own[1]);
      } else {
        EXPECT_EQ(torque[1 - at], 0.0);
      }
      step = kArmPeriod;
    }
    // the judge's differences of rates err, most where these grow as a broken power of the state
    const double differences = GetParam() == "bouc_wen" ? 1e-3 : 1e-5;
    EXPECT_LT(error.value(), effect_->states.empty() ? 1e-12 : differences)
        << GetParam() << " of joint " << joint;
  }

  std::shared_ptr<const EffectFile> effect_ = EffectCatalogue().find(GetParam());
  std::map<std::string, double> values_;
};

TEST_P(EveryEffect, TorqueIsWhatItsFileSays) {
  GeneratorOptions options = functions_of({"effects", "id_rigid"});
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    options.parameters = mode;
    for (const bool regroup : {true, false}) {
      options.regroup = regroup;
      expect_torque(1, options);
      expect_torque(2, options);
    }
  }
}

TEST_P(EveryEffect, IsTheDifferenceOfIdAndTheRigidModelWithFriction) {
  const std::string row = row_of(*effect_, values_);
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    GeneratorOptions options;
    options.functions = {"id", "id_rigid", "friction", "effects"};
    options.parameters = mode;
    const EvaluatedModel with(arm_with(row), options);
    options.functions = {"friction"};
    const EvaluatedModel without(arm_with(""), options);
    EffectState of_id = with.new_state(kArmPeriod), of_friction = of_id, of_effects = of_id;
    RelativeError id, friction;
    for (const MotionSample& sample : arm_motion()) {
      const std::vector<double> effects = evaluated_call(with, "effects", sample, of_effects);
      const std::vector<double> both = sum(without.call("friction", sample), effects);
      friction.add(evaluated_call(with, "friction", sample, of_friction), both);
      id.add(evaluated_call(with, "id", sample, of_id), sum(with.call("id_rigid", sample), both));
    }
    EXPECT_LT(id.value(), 1e-12) << GetParam();
    EXPECT_LT(friction.value(), 1e-12) << GetParam();
  }
}

TEST_P(EveryEffect, CompiledIsEvaluated) {
  GeneratorOptions options;
  options.functions = {"id", "effects"};
  options.trig = Trig::kLibm;
  const RobotModel model = arm_with(row_of(*effect_, values_));
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, options);
  for (const std::string& function : options.functions) {
    RelativeError error;
    const bool stateful = !effect_->states.empty();
    EffectState own = stateful ? compiled.new_state(kArmPeriod) : EffectState();
    EffectState state = evaluated.new_state(kArmPeriod);
    for (const MotionSample& sample : arm_motion()) {
      error.add(stateful ? compiled.advance(function, sample, evaluated.chi(), own)
                         : compiled.call(function, sample, evaluated.chi()),
                evaluated_call(evaluated, function, sample, state));
    }
    EXPECT_LT(error.value(), 4e-15) << GetParam() << " " << function;
    EXPECT_EQ(own.step, stateful ? kArmPeriod : 0.0);
  }
}

TEST(EffectsOfControllers, AreMostOfTheCatalogue) {
  const EffectCatalogue catalogue;
  int running = 0;
  for (const auto& effect : catalogue.all()) running += effect->runs_in_controller() ? 1 : 0;
  EXPECT_GT(running, 35);
}

INSTANTIATE_TEST_SUITE_P(catalogue, EveryEffect, testing::ValuesIn(effect_names()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace dyngen::test
