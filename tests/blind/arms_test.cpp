// SPDX-License-Identifier: MIT
// The one place where the suite's arms and the robot files that dynid gets are held together.
#include <gtest/gtest.h>

#include "tests/blind/simulation/engine.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

const std::string kArms = DYNGEN_SOURCE_DIR "/tests/blind/arms/";

Inertia inertia_of(const dyngen::test::NumericJoint& joint) {
  const auto& [xx, xy, xz, yy, yz, zz, mx, my, mz, m] = joint.inertial;
  Inertia inertia;
  inertia.mass = m;
  inertia.com = Eigen::Vector3d(mx, my, mz) / m;
  const Eigen::Vector3d& c = inertia.com;
  inertia.about_com << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  inertia.about_com -= m * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return inertia;
}

class EveryArm : public testing::TestWithParam<std::string> {};

TEST_P(EveryArm, HasTheGeometryOfItsRobotFile) {
  const Arm arm = read_arm(kArms + GetParam() + ".xml");
  const auto model = dyngen::test::with_random_values(
      dyngen::test::read_model("tests/blind/arms/" + GetParam() + ".robot"), 7);
  const auto robot = dyngen::test::numeric_robot(model);
  Tree tree = arm.tree;
  ASSERT_EQ(tree.links.size(), robot.size());
  for (std::size_t i = 0; i < robot.size(); ++i) {
    tree.links[i].inertia = inertia_of(robot.joints[i]);
  }
  const Engine mujoco = mujoco_engine(tree), dart = dart_engine(tree);
  for (const auto& sample :
       dyngen::test::random_samples(static_cast<int>(robot.size()), 20, 20261122)) {
    const auto map = [](const std::vector<double>& values) -> VectorXd {
      return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
    };
    const VectorXd expected =
        map(dyngen::test::id_rigid<double>(robot, sample.q, sample.dq, sample.ddq));
    const double scale = expected.cwiseAbs().maxCoeff();
    const VectorXd q = map(sample.q), dq = map(sample.dq), ddq = map(sample.ddq);
    // the files round pi and the twists' sines to 17 digits
    EXPECT_LT((mujoco.inverse(q, dq, ddq) - expected).cwiseAbs().maxCoeff(), 1e-9 * scale);
    EXPECT_LT((dart.inverse(q, dq, ddq) - expected).cwiseAbs().maxCoeff(), 1e-9 * scale);
    for (const Engine& engine : {mujoco, dart}) {
      Dynamics dynamics;
      engine.dynamics(q, dq, dynamics);
      EXPECT_LT((dynamics.M * ddq + dynamics.bias - expected).cwiseAbs().maxCoeff(), 1e-9 * scale)
          << engine.name;
    }
    const int last = static_cast<int>(robot.size()) - 1;
    const Eigen::Vector3d point(0.1, -0.2, 0.3);
    EXPECT_LT((mujoco.jacobian(q, last, point) - dart.jacobian(q, last, point)).norm(), 1e-9);
    EXPECT_LT((mujoco.place(q, last, point) - dart.place(q, last, point)).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Blind, EveryArm,
                         testing::Values("planar2", "twisted4", "puma560", "ur10e", "panda"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace blind
