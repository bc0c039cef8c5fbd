// SPDX-License-Identifier: MIT
// The compiled text computes what the evaluated program computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/support/compiled_model.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::compiled_tests {
namespace {

constexpr int kSamples = 50;
const std::vector<std::string> kFunctions = {"id", "id_rigid", "gravity", "coriolis", "friction"};

std::vector<std::string> all_robots() {
  std::vector<std::string> paths;
  for (const std::string folder : {"robots", "tests/robots"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(DYNGEN_SOURCE_DIR "/") + folder)) {
      if (entry.path().extension() == ".robot") {
        paths.push_back(folder + "/" + entry.path().filename().string());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

class EveryRobot : public testing::TestWithParam<std::string> {};

/// One file, in one way of taking parameters: compiled against evaluated.
double largest_difference(const RobotModel& model, const GeneratorOptions& options,
                          const EvaluatedModel& evaluated) {
  const CompiledModel compiled(model, options);
  RelativeError error;
  for (const MotionSample& sample : random_samples(model.coordinate_count, kSamples, 5)) {
    for (const std::string& function : kFunctions) {
      error.add(compiled.call(function, sample, evaluated.chi()), evaluated.call(function, sample));
    }
  }
  return error.value();
}

TEST_P(EveryRobot, CompiledEqualsEvaluatedToTheLastBits) {
  const RobotModel model = read_model(GetParam());
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    GeneratorOptions options;
    options.functions = kFunctions;
    options.parameters = mode;
    options.trig = Trig::kInline;
    const EvaluatedModel evaluated(model, with_random_values(model, 11), options);
    // the same operations in the same order
    EXPECT_LT(largest_difference(model, options, evaluated), 4e-16) << GetParam();
    options.trig = Trig::kLibm;
    // sines and cosines that differ in the last bit
    EXPECT_LT(largest_difference(model, options, evaluated), 4e-15) << GetParam();
  }
}

TEST_P(EveryRobot, SinglePrecisionAgreesToSinglePrecision) {
  GeneratorOptions options;
  options.functions = kFunctions;
  options.scalar = Scalar::kFloat;
  const RobotModel model = read_model(GetParam());
  const EvaluatedModel evaluated(model, with_random_values(model, 11), options);
  // some hundred operations at 6e-8 each
  EXPECT_LT(largest_difference(model, options, evaluated), 2e-5) << GetParam();
}

TEST_P(EveryRobot, CompiledEqualsTheJudge) {
  const RobotModel model = read_model(GetParam());
  const RobotModel values = with_random_values(model, 3);
  const NumericRobot numbers = numeric_robot(values);
  GeneratorOptions options;
  options.functions = kFunctions;
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, values, options);
  for (const std::string& function : kFunctions) {
    RelativeError error;
    error.add(1e-3, 1e-3);  // a robot without this torque is judged against 1 mN m
    for (const MotionSample& sample : random_samples(model.coordinate_count, kSamples, 9)) {
      error.add(compiled.call(function, sample, evaluated.chi()),
                judge(values, numbers, function, sample));
    }
    EXPECT_LT(error.value(), 1e-10) << GetParam() << " " << function;
  }
}

TEST_P(EveryRobot, TableOfNumbersIsWhatTheFileSays) {
  const RobotModel model = read_model(GetParam());
  GeneratorOptions options;
  options.functions = {"friction"};
  options.parameters = ParameterMode::kRuntime;
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, with_random_values(model, 3), options);
  const std::vector<double> written = compiled.chi_values();
  ASSERT_EQ(written.size(), evaluated.chi().size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (evaluated.code().chi[i].value) {
      EXPECT_EQ(written[i], evaluated.chi()[i]) << evaluated.code().chi[i].name;
    } else {
      EXPECT_TRUE(std::isnan(written[i])) << evaluated.code().chi[i].name;
    }
  }
}

TEST_P(EveryRobot, OutputMayTakeThePlaceOfAnInput) {
  const RobotModel model = read_model(GetParam());
  GeneratorOptions options;
  options.functions = {"id"};
  const EvaluatedModel evaluated(model, with_random_values(model, 3), options);
  const CompiledModel compiled(model, options);
  const MotionSample sample = random_samples(model.coordinate_count, 2, 21)[1];
  EXPECT_EQ(compiled.call_in_place("id", sample, evaluated.chi()),
            compiled.call("id", sample, evaluated.chi()));
}

INSTANTIATE_TEST_SUITE_P(Files, EveryRobot, testing::ValuesIn(all_robots()), [](const auto& robot) {
  return std::filesystem::path(robot.param).stem().string();
});

}  // namespace
}  // namespace dyngen::test::compiled_tests
