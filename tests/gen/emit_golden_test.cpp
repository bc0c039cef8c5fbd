// SPDX-License-Identifier: MIT
// The whole text of three tiny robots: what a change of the generator does to the code shows in
// review.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "gen/generator/generator.h"
#include "tests/support/golden.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

struct GoldenCase {
  std::string name;
  std::string robot;
  GeneratorOptions options;
};

std::vector<GoldenCase> cases() {
  GeneratorOptions baked;
  baked.functions = {"id", "gravity", "coriolis", "friction"};
  baked.cpp_wrapper = true;
  GeneratorOptions runtime = baked;
  runtime.parameters = ParameterMode::kRuntime;
  GeneratorOptions single = baked;
  single.scalar = Scalar::kFloat;
  return {{"planar2r_runtime", "robots/planar2r.robot", runtime},
          {"rp_baked", "tests/robots/rp.robot", baked},
          {"pendulum_float", "tests/robots/pendulum.robot", single}};
}

class EmittedText : public testing::TestWithParam<GoldenCase> {};

TEST_P(EmittedText, IsAsCommitted) {
  const CText text = generate(read_model(GetParam().robot), GetParam().options);
  expect_golden("emitted/" + GetParam().name + ".h", text.header);
  expect_golden("emitted/" + GetParam().name + ".c", text.source);
  expect_golden("emitted/" + GetParam().name + ".hpp", text.wrapper);
}

INSTANTIATE_TEST_SUITE_P(golden, EmittedText, testing::ValuesIn(cases()),
                         [](const auto& golden) { return golden.param.name; });

}  // namespace
}  // namespace dyngen::test
