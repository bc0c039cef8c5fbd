// SPDX-License-Identifier: MIT
// What effects remember between two calls of emitted code.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/compiled_model.h"
#include "tests/support/effect_arm.h"

namespace dyngen::test {
namespace {

TEST(EffectStates, FirstCallAfterResetLeavesThemAndFurtherOnesMoveThem) {
  GeneratorOptions options;
  options.functions = {"id"};
  const RobotModel model = arm_with("effect dahl joint=2 F=1.2 zs=0.004");
  const CompiledModel compiled(model, options);
  EffectState state = compiled.new_state(kArmPeriod);
  EXPECT_EQ(state.z, std::vector<double>{0.0});
  EXPECT_EQ(state.step, 0.0);
  EXPECT_EQ(state.dt, kArmPeriod);
  MotionSample sample;
  sample.q = {0.1, 0.2};
  sample.dq = {0.3, 0.8};
  sample.ddq = {0.0, 0.0};
  compiled.advance("id", sample, {}, state);
  EXPECT_EQ(state.z[0], 0.0);
  EXPECT_EQ(state.last, std::vector<double>{0.8});
  EXPECT_EQ(state.step, kArmPeriod);
  // Dahl 1968 at a constant speed: z = 1 - exp(-distance / zs), exactly
  for (int k = 1; k <= 20; ++k) {
    compiled.advance("id", sample, {}, state);
    EXPECT_NEAR(state.z[0], 1 - std::exp(-0.8 * k * kArmPeriod / 0.004), 1e-14);
  }
}

TEST(EffectStates, StartAtTheNearestPointWithinTheirLimits) {
  GeneratorOptions options;
  options.functions = {"effects"};
  const RobotModel model = arm_with("effect maxwell_slip joint=2 F1=1 F2=1 F3=1 F4=1 zs=0.001");
  const CompiledModel compiled(model, options);
  EXPECT_EQ(compiled.new_state(0.1).z, (std::vector<double>(4, 0.0)));
  // far too long a step ends at the limits
  EffectState state = compiled.new_state(1.0);
  MotionSample sample;
  sample.q = sample.ddq = {0.0, 0.0};
  sample.dq = {0.0, -2.0};
  compiled.advance("effects", sample, {}, state);
  compiled.advance("effects", sample, {}, state);
  EXPECT_EQ(state.z, (std::vector<double>{-0.001, -0.002, -0.004, -0.008}));
}

TEST(EffectStates, StaysBoundedAtAnyPeriod) {
  GeneratorOptions options;
  options.functions = {"effects"};
  for (const char* rows : {"effect dahl joint=2 F=1 zs=0.0001",
                           "effect lugre joint=2 F=1 rise=1.5 "
                           "vs=0.02 zs=0.0001"}) {
    const EvaluatedModel evaluated(arm_with(rows), options);
    for (const double period : {1e-5, 1e-3, 0.1}) {
      EffectState state = evaluated.new_state(period);
      for (const MotionSample& sample : arm_motion()) {
        evaluated.advance("effects", sample, state);
        EXPECT_LE(std::abs(state.z[0]), 1.5 * (1 + 1e-12)) << rows << " " << period;
      }
    }
  }
}

TEST(EffectStates, HeaderNamesThem) {
  const CText text = generate(arm_with(kStatefulRows), functions_of({"id"}));
  for (const char* part :
       {"#define PLANAR2R_NSTATE 8 ", "void planar2r_reset(planar2r_state *s, double dt);",
        "void planar2r_id(planar2r_state *s, const double *q, const double *dq,"}) {
    EXPECT_NE(text.header.find(part), std::string::npos) << part;
  }
  for (const char* part : {"\"dahl_1_z\"", "\"maxwell_slip_2_z4\"", "\"thermal_power_2_power\""}) {
    EXPECT_NE(text.source.find(part), std::string::npos) << part;
  }
}

TEST(EffectStates, FunctionsWithoutThemTakeNoState) {
  const CText text = generate(arm_with(kStatefulRows), functions_of({"id_rigid", "gravity"}));
  EXPECT_EQ(text.header.find("_state"), std::string::npos);
  EXPECT_NE(text.header.find("The robot's effects are left out."), std::string::npos);
}

}  // namespace
}  // namespace dyngen::test
