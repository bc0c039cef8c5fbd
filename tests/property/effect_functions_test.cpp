// SPDX-License-Identifier: MIT
// Which functions a robot with effects has, and what they read.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "tests/support/effect_arm.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

std::string refusal(const std::string& rows, const GeneratorOptions& options) {
  try {
    (void)generate(arm_with(rows), with_short_search(options));
  } catch (const ModelError& error) {
    return error.what();
  }
  return {};
}

TEST(EffectFunctions, FrictionReadsOnlyWhatItsEffectsDo) {
  GeneratorOptions options;
  options.functions = {"friction"};
  EXPECT_NE(generate(arm_with("effect stribeck joint=2 Fs=3 vs=0.1"), options)
                .header.find("void planar2r_friction(const double *dq, double *tau);"),
            std::string::npos);
  EXPECT_NE(generate(arm_with("effect cogging joint=2 a=1 b=0 n=10"), options)
                .header.find("void planar2r_friction(const double *q, const double *dq, const "
                             "double *ddq,"),
            std::string::npos);
}

TEST(EffectFunctions, RobotWithoutEffectsHasNoFunctionOfThem) {
  EXPECT_NE(refusal("", functions_of({"effects"}))
                .find("the robot has no effect that runs in a controller"),
            std::string::npos);
  EXPECT_EQ(generate(arm_with(""), {}).header.find("_effects"), std::string::npos);
}

TEST(EffectFunctions, ForwardDynamicsTakesThemOff) {
  GeneratorOptions options;
  options.functions = {"id", "fd"};
  for (const std::string rows : {"effect stribeck joint=2 Fs=3 vs=0.1\neffect cogging joint=1 a=1 "
                                 "b=0.5 n=9",
                                 "effect dahl joint=1 F=1 zs=0.002"}) {
    const EvaluatedModel model(arm_with(rows), options);
    EffectState of_id = model.new_state(kArmPeriod), of_fd = of_id;
    RelativeError error;
    for (MotionSample sample : arm_motion()) {
      sample.tau = evaluated_call(model, "id", sample, of_id);
      error.add(evaluated_call(model, "fd", sample, of_fd), sample.ddq);
    }
    EXPECT_LT(error.value(), 1e-12) << rows;
  }
}

TEST(EffectFunctions, NoForwardDynamicsWhereTheTorqueDependsOnAccelerations) {
  for (const char* rows :
       {"effect load_friction joint=2 mu=0.1", "effect rotor_inertia joint=1 J=1",
        "effect inertial_coupling joint=2 other=1 I=0.1 ratio=1"}) {
    EXPECT_NE(refusal(rows, functions_of({"fd"})).find("an effect reads accelerations"),
              std::string::npos)
        << rows;
  }
}

TEST(EffectFunctions, NoBatchOfWhatRemembers) {
  EXPECT_NE(refusal(kStatefulRows, functions_of({"id_batch"}))
                .find("'id_batch': effects of this robot remember the call before"),
            std::string::npos);
  const CText text = generate(arm_with(kStatefulRows), with_short_search(functions_of({"all"})));
  EXPECT_EQ(text.header.find("planar2r_id_batch"), std::string::npos);
  EXPECT_NE(text.header.find("planar2r_gravity_batch"), std::string::npos);
}

TEST(EffectFunctions, EffectsCanBeLeftOut) {
  GeneratorOptions options;
  options.functions = {"id", "friction"};
  const CText without = generate(arm_with(""), options);
  options.effects = false;
  const CText left_out = generate(arm_with(kStatefulRows), options);
  EXPECT_EQ(left_out.source, without.source);
  EXPECT_EQ(left_out.header, without.header);
}

TEST(EffectFunctions, RegressorColumnsOfTheirParametersAreZero) {
  GeneratorOptions options;
  options.functions = {"regressor"};
  options.parameters = ParameterMode::kRuntime;
  const EvaluatedModel with(arm_with(kAlgebraicRows), options), without(arm_with(""), options);
  const std::size_t columns = with.code().chi.size(), own = without.code().chi.size();
  ASSERT_GT(columns, own);
  for (const MotionSample& sample : arm_motion(5)) {
    const std::vector<double> Y = with.call("regressor", sample);
    const std::vector<double> rigid = without.call("regressor", sample);
    for (std::size_t k = 0; k < Y.size(); ++k) {
      const std::size_t column = k % columns;
      EXPECT_EQ(Y[k], column < own ? rigid[k / columns * own + column] : 0.0) << k;
    }
  }
}

TEST(EffectFunctions, UnknownRotorInertiaThatIsGroupedIsRefused) {
  const std::string row = "effect load_friction_directional joint=1 km=0.1 ke=0.05";
  RobotModel model = arm_with(row);
  model.joints[0].chi[index(Chi::kIA)].unknown = true;
  GeneratorOptions options;
  options.functions = {"id"};
  EXPECT_THROW((void)generate(model, options), ModelError);
  options.regroup = false;
  EXPECT_NO_THROW((void)generate(model, options));
}

}  // namespace
}  // namespace dyngen::test
