// SPDX-License-Identifier: MIT
// Poses and Jacobians of every frame, against the judge's transforms, which take both DH
// conventions as they are.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/frame_error.h"
#include "tests/support/model_bridge.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::kinematics_tests {
namespace {

// Products of 12 matrices in double: some 1e-15 each.
constexpr double kTolerance = 1e-12;

class Kinematics : public testing::TestWithParam<std::string> {};

TEST_P(Kinematics, EveryFrameEqualsTheJudge) {
  const RobotModel model = read_model(GetParam());
  const RobotModel values = with_random_values(model, 4);
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    GeneratorOptions options;
    options.parameters = mode;
    EXPECT_LT(frame_error(model, values, options, 10), kTolerance);
  }
}

/// What a force on the frame does on its way is what the joints do: J^T f is the torque that the
/// wrench argument of id takes off, in the frame's own axes.
TEST_P(Kinematics, TransposeOfTheJacobianIsTheTorqueOfAWrench) {
  const RobotModel model = read_model(GetParam());
  GeneratorOptions options;
  options.wrench = true;
  options.functions = {"id", "fk", "jacobian"};
  const EvaluatedModel evaluated(model, with_random_values(model, 4), options);
  const std::size_t n = static_cast<std::size_t>(model.coordinate_count);
  RelativeError error;
  for (MotionSample sample : random_samples(model.coordinate_count, 10, 8)) {
    const std::vector<double> T = evaluated.call("fk", sample);
    const std::vector<double> J = evaluated.call("jacobian", sample);
    const std::vector<double> loaded = evaluated.call("id", sample);
    std::vector<double> base(6, 0.0);  // the wrench in the axes of frame 0
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        base[k] += T[4 * (k % 3) + i] * sample.wrench[i + (k < 3 ? 0 : 3)];
      }
    }
    sample.wrench.assign(6, 0.0);
    const std::vector<double> free = evaluated.call("id", sample);
    for (std::size_t i = 0; i < n; ++i) {
      double work = 0;
      for (std::size_t k = 0; k < 6; ++k) work += J[k * n + i] * base[k];
      error.add(loaded[i], free[i] - work);
    }
  }
  EXPECT_LT(error.value(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, Kinematics,
    testing::Values("robots/planar2r.robot", "robots/puma560.robot", "robots/rx90.robot",
                    "robots/ur10e.robot", "robots/panda.robot", "robots/stanford.robot",
                    "robots/scara.robot", "robots/sarcos_grla.robot", "robots/kuka_iiwa14.robot",
                    "tests/robots/puma560_corke_std.robot", "tests/robots/odd_angles.robot",
                    "tests/robots/flip3r.robot", "tests/robots/rp.robot"),
    [](const auto& entry) {
      const std::string path = entry.param;
      const std::size_t begin = path.rfind('/') + 1;
      return path.substr(begin, path.rfind('.') - begin);
    });

TEST(FunctionNames, OfALinkEndInItsNumber) {
  EXPECT_EQ(parse_function_name("fk").link, 0);
  EXPECT_EQ(parse_function_name("fk_12").link, 12);
  EXPECT_EQ(parse_function_name("fk_12").text(), "fk_12");
  EXPECT_EQ(parse_function_name("jacobian_1").spec, find_function("jacobian"));
  for (const char* wrong : {"fk_", "fk_0", "fk_01", "fk_x", "fk_1x", "fk1", "id_1", "fk_-1",
                            "fk_99999999999", "jacobian_ 1"}) {
    EXPECT_EQ(find_function(wrong), nullptr) << wrong;
  }
}

TEST(FunctionNames, OfALinkThatTheRobotLacksAreRefused) {
  const RobotModel model = read_model("robots/planar2r.robot");
  GeneratorOptions options;
  options.functions = {"fk_3"};
  try {
    options.validate(model);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "--functions: 'fk_3': planar2r has no link 3; expected fk_1 to fk_2");
  }
}

}  // namespace
}  // namespace dyngen::test::kinematics_tests
