// SPDX-License-Identifier: MIT
#include "tests/support/frame_error.h"

#include <array>
#include <string>
#include <vector>

#include "tests/support/model_bridge.h"
#include "tests/support/numeric_derivatives.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

std::vector<std::string> frame_functions(const RobotModel& model) {
  std::vector<std::string> names = {"fk", "jacobian"};
  for (int j = 1; j <= model.size(); ++j) {
    names.push_back("fk_" + std::to_string(j));
    names.push_back("jacobian_" + std::to_string(j));
  }
  return names;
}

}  // namespace

double frame_error(const RobotModel& model, const RobotModel& values, GeneratorOptions options,
                   int samples) {
  options.functions = frame_functions(model);
  const EvaluatedModel evaluated(model, values, options);
  const NumericRobot numbers = numeric_robot(values);
  const std::size_t n = static_cast<std::size_t>(model.coordinate_count);
  RelativeError error;
  error.add(1.0, 1.0);  // lengths are judged against 1 m
  for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 3)) {
    const std::vector<long double> q = joint_values(model, sample.q);
    const std::vector<Transform<long double>> poses = forward_kinematics(numbers, q);
    for (std::size_t link = 0; link <= model.joints.size(); ++link) {
      // link 0: the names without a number, which speak of the last one
      const std::string suffix = link == 0 ? "" : "_" + std::to_string(link);
      const std::size_t at = link == 0 ? model.joints.size() - 1 : link - 1;
      const std::vector<double> T = evaluated.call("fk" + suffix, sample);
      for (std::size_t k = 0; k < 16; ++k) {
        error.add(T[k], poses[at](static_cast<int>(k / 4), static_cast<int>(k % 4)));
      }
      const std::vector<double> J = evaluated.call("jacobian" + suffix, sample);
      for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
        if (model.joints[joint].coordinate < 0) continue;
        const std::size_t column = static_cast<std::size_t>(model.joints[joint].coordinate);
        const std::array<long double, 6> reference = joint_screw(numbers, q, joint, at);
        for (std::size_t k = 0; k < 6; ++k) error.add(J[k * n + column], reference[k]);
      }
    }
  }
  return error.value();
}

}  // namespace dyngen::test
