// SPDX-License-Identifier: MIT
// The torque of a wrench on any link against the judge's virtual work, and the argument wrench on
// any link against it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/body_robots.h"
#include "tests/support/compiled_model.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_centroid.h"
#include "tests/support/numeric_derivatives.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::external_torque_tests {
namespace {

constexpr double kTolerance = 1e-10;

/// Of every link's function.
double external_error(const RobotModel& model, const RobotModel& values, GeneratorOptions options,
                      int samples) {
  options.functions = {"external_torque"};
  for (int j = 1; j <= model.size(); ++j) {
    options.functions.push_back(fmt::format("external_torque_{}", j));
  }
  const EvaluatedModel evaluated(model, values, options);
  const NumericRobot robot = numeric_robot(values);
  RelativeError error;
  error.add(1.0, 1.0);
  for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 5)) {
    const std::vector<long double> w(sample.wrench.begin(), sample.wrench.end());
    for (int j = 0; j <= model.size(); ++j) {
      const std::string name = "external_torque" + (j == 0 ? "" : fmt::format("_{}", j));
      const auto link = static_cast<std::size_t>(j == 0 ? model.size() - 1 : j - 1);
      error.add(evaluated.call(name, sample), torque_of_wrench(values, robot, sample.q, link, w));
    }
  }
  return error.value();
}

/// id with the argument wrench on a link against id of the judge less the work of the wrench, whose
/// axes are those of the link's frame.
double wrench_error(const RobotModel& model, const RobotModel& values, GeneratorOptions options,
                    int samples) {
  const NumericRobot robot = numeric_robot(values);
  RelativeError error;
  error.add(1.0, 1.0);
  for (int j = 1; j <= model.size(); ++j) {
    options.functions = {"id"};
    options.wrench = true;
    options.wrench_link = j;
    const EvaluatedModel evaluated(model, values, options);
    for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 6)) {
      const auto link = static_cast<std::size_t>(j - 1);
      const auto loaded = [&](const std::vector<double>& q) {
        const Transform<long double> T = forward_kinematics(robot, joint_values(values, q))[link];
        std::vector<long double> w(6, 0.0L);
        for (std::size_t k = 0; k < 6; ++k) {
          for (std::size_t i = 0; i < 3; ++i) {
            w[k] += T(static_cast<int>(k % 3), static_cast<int>(i)) *
                    static_cast<long double>(sample.wrench[i + (k < 3 ? 0 : 3)]);
          }
        }
        MotionSample moved = sample;
        moved.q = q;
        std::vector<double> torque = judge(values, robot, "id", moved);
        const std::vector<long double> work = torque_of_wrench(values, robot, q, link, w);
        for (std::size_t i = 0; i < torque.size(); ++i) {
          torque[i] -= static_cast<double>(work[i]);
        }
        return torque;
      };
      error.add(evaluated.call("id", sample), loaded(sample.q));
    }
  }
  return error.value();
}

class ExternalTorque : public testing::TestWithParam<std::string> {};

TEST_P(ExternalTorque, OfEveryLinkIsTheWorkOfItsWrench) {
  const RobotModel model = read_model(GetParam());
  EXPECT_LT(external_error(model, with_random_values(model, 4), {}, 5), kTolerance);
}

TEST_P(ExternalTorque, IsWhatTheWrenchOfThatLinkTakesOff) {
  const RobotModel model = read_model(GetParam());
  EXPECT_LT(wrench_error(model, with_random_values(model, 4), {}, 3), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Robots, ExternalTorque,
                         testing::Values("robots/planar2r.robot", "robots/puma560.robot",
                                         "robots/panda.robot", "robots/stanford.robot",
                                         "robots/scara.robot",
                                         "tests/robots/puma560_corke_std.robot",
                                         "tests/robots/odd_angles.robot",
                                         "tests/robots/flip3r.robot", "tests/robots/rp.robot"),
                         [](const auto& entry) {
                           const std::string path = entry.param;
                           const std::size_t begin = path.rfind('/') + 1;
                           return path.substr(begin, path.rfind('.') - begin);
                         });

TEST(ExternalTorqueOfRandomRobots, IsTheWorkOfTheWrench) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  robots.insert(robots.end(), trees.begin(), trees.end());
  for (const auto& [name, robot] : robots) {
    const RobotModel values = robot_model(robot);
    RobotModel model = values;
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = name.size() % 2 == 0;
    EXPECT_LT(external_error(model, values, {}, 3), kTolerance) << name;
    EXPECT_LT(wrench_error(model, values, every_mode()[name.size() % 4], 2), kTolerance) << name;
  }
}

/// The position derivatives see the wrench of a link in the middle too.
TEST(ExternalTorqueOfRandomRobots, DerivativesSeeTheWrenchOfAnyLink) {
  for (const NamedRobot& named : {random_chains()[5], random_trees()[4]}) {
    const RobotModel model = robot_model(named.robot);
    for (int j = 1; j <= model.size(); ++j) {
      GeneratorOptions options;
      options.functions = {"id", "id_dq_pos"};
      options.wrench = true;
      options.wrench_link = j;
      const EvaluatedModel evaluated(model, options);
      const auto n = static_cast<std::size_t>(model.coordinate_count);
      RelativeError error;
      error.add(1.0, 1.0);
      for (const MotionSample& sample : random_samples(model.coordinate_count, 3, 8)) {
        const std::vector<double> D = evaluated.call("id_dq_pos", sample);
        for (std::size_t k = 0; k < n; ++k) {
          const double h = 1e-5;  // truncation h^2, rounding 1e-15 / h: 1e-9 of the torque
          MotionSample before = sample, after = sample;
          before.q[k] -= h;
          after.q[k] += h;
          const std::vector<double> a = evaluated.call("id", before);
          const std::vector<double> b = evaluated.call("id", after);
          for (std::size_t i = 0; i < n; ++i) error.add(D[i * n + k], (b[i] - a[i]) / (2 * h));
        }
      }
      EXPECT_LT(error.value(), 1e-6) << named.name << " link " << j;
    }
  }
}

TEST(ExternalTorque, CompiledEqualsEvaluatedAndSaysItsFrame) {
  const RobotModel model = read_model("robots/scara.robot");
  GeneratorOptions options;
  options.functions = {"external_torque_3", "id"};
  options.wrench = true;
  options.wrench_link = 2;
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, options);
  RelativeError error;
  for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 6)) {
    error.add(compiled.call("external_torque_3", sample, {}),
              evaluated.call("external_torque_3", sample));
    error.add(compiled.call("id", sample, {}), evaluated.call("id", sample));
  }
  EXPECT_LT(error.value(), 1e-13);
  const CText text = generate(model, with_short_search(options));
  EXPECT_NE(text.header.find("w[6] N, N m: on the link, about its origin, in the axes of frame 0"),
            std::string::npos);
  EXPECT_NE(text.header.find("wrench[6] N, N m: on link 2, about its origin, in its frame"),
            std::string::npos);
}

TEST(ExternalTorque, OfALinkThatTheRobotLacksIsRefused) {
  const RobotModel model = read_model("robots/planar2r.robot");
  GeneratorOptions options;
  options.wrench = true;
  options.wrench_link = 3;
  EXPECT_THROW(options.validate(model), std::invalid_argument);
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(ExternalTorqueOfRandomRobots, EqualsTheJudge, ()) {
  const RobotModel values = robot_model(random_robot());
  RC_ASSERT(external_error(values, values, {}, 2) < kTolerance);
}
#endif

}  // namespace
}  // namespace dyngen::test::external_torque_tests
