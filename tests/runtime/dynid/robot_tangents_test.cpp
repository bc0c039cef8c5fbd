// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/robot_tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/effects/effect_signals.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::NumericJoint;
using test::NumericRobot;
using Values = std::vector<long double>;

constexpr int kSamples = 7;
constexpr unsigned kTangentSeed = 20261121;
constexpr double kTolerance = 1e-6;  // of central differences; what is found is some 1e-10
constexpr const char* kRobots[] = {"tests/robots/puma560_corke_std.robot",
                                   "tests/robots/ur10e_oracle.robot", "tests/robots/rp.robot"};

/// A robot of a file, the judge's twin of it, and a random motion.
struct TangentCase {
  explicit TangentCase(const std::string& path)
      : robot(
            describe_robot(std::string(DYNGEN_SOURCE_DIR "/") + path, OpenParameters::kAsWritten)),
        twin(test::numeric_robot(robot.model)),
        beta(robot.grouping * robot.standard) {
    for (NumericJoint& joint : twin.joints) joint.IA = joint.Fs = joint.Fv = joint.off = 0;
    std::mt19937 random(kTangentSeed);
    std::uniform_real_distribution<double> uniform(-2, 2);
    const Index n = robot.model.coordinate_count;
    for (MatrixXd* part : {&motion.q, &motion.dq, &motion.ddq}) {
      *part = MatrixXd::NullaryExpr(kSamples, n, [&] { return uniform(random); });
    }
  }

  /// One value for each joint of the judge, from one for each coordinate.
  [[nodiscard]] Values per_joint(const MatrixXd& part, Index sample) const {
    Values values;
    for (const JointModel& joint : robot.model.joints) {
      values.push_back(joint.coordinate < 0 ? 0.0L : part(sample, joint.coordinate));
    }
    return values;
  }
  [[nodiscard]] Values torque(const NumericRobot& changed, Index sample) const {
    return test::id_rigid(changed, per_joint(motion.q, sample), per_joint(motion.dq, sample),
                          per_joint(motion.ddq, sample));
  }

  DescribedRobot robot;
  NumericRobot twin;
  VectorXd beta;
  JointMotion motion;
};

/// One of the robot's tangents at a time.
class Tangent {
 public:
  explicit Tangent(const TangentCase& own) : tangents_(robot_tangents(own.robot)) {}
  MatrixXd operator()(const std::string& name, int link, const JointMotion& motion,
                      const VectorXd& beta, double further = 0) const {
    return tangents_({name, link}, motion, beta, further).at({name, link});
  }

 private:
  TangentFunction tangents_;
};

/// Central differences of the judge by a number of the robot, beside the tangent.
double error_of(const TangentCase& own, const MatrixXd& tangent,
                const std::function<void(NumericRobot&, double)>& change) {
  constexpr double kStep = 1e-5;
  test::RelativeError error;
  for (Index k = 0; k < kSamples; ++k) {
    NumericRobot more = own.twin, less = own.twin;
    change(more, kStep);
    change(less, -kStep);
    const Values above = own.torque(more, k), below = own.torque(less, k);
    for (std::size_t j = 0; j < own.twin.size(); ++j) {
      const int coordinate = own.robot.model.joints[j].coordinate;
      if (coordinate < 0) continue;
      error.add(tangent(k, coordinate), (above[j] - below[j]) / (2 * kStep));
    }
  }
  return error.value();
}

class RobotTangents : public testing::TestWithParam<const char*> {};

TEST_P(RobotTangents, ByConstantsOfTheTableAreDifferencesOfTheTorque) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  const auto check = [&](const std::string& name, int link, double NumericJoint::*constant) {
    const MatrixXd found = tangent(name, link, own.motion, own.beta);
    const double error = error_of(own, found, [&](NumericRobot& robot, double step) {
      robot.joints[static_cast<std::size_t>(link - 1)].*constant += step;
    });
    // a constant that turns or moves the whole robot about gravity changes nothing: 0 against 0
    if (found.cwiseAbs().maxCoeff() < 1e-9) return;
    EXPECT_LT(error, kTolerance) << name << " of link " << link;
  };
  for (int link = 1; link <= own.robot.model.size(); ++link) {
    check("d_alpha", link, &NumericJoint::alpha);
    check("d_d", link, &NumericJoint::d);
    check("d_theta", link, &NumericJoint::theta);
    check("d_r", link, &NumericJoint::r);
  }
}

TEST_P(RobotTangents, ByGravityAndPayloadAreDifferencesOfTheTorque) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  const std::string gravity[] = {"d_gx", "d_gy", "d_gz"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(
        error_of(own, tangent(gravity[k], 0, own.motion, own.beta),
                 [&](NumericRobot& robot, double step) { robot.base_acceleration[k] += step; }),
        kTolerance)
        << gravity[k];
  }
  const std::string parameters[] = {"XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"};
  const std::size_t links = own.twin.joints.size();
  for (std::size_t link = 0; link <= links; ++link) {  // 0: the last one
    for (std::size_t k = 0; k < 10; ++k) {
      const MatrixXd found =
          tangent("payload_" + parameters[k], static_cast<int>(link), own.motion, own.beta);
      const double error = error_of(own, found, [&](NumericRobot& robot, double step) {
        robot.joints[link == 0 ? links - 1 : link - 1].inertial[k] += step;
      });
      constexpr double kRounding = 1e-12;  // of the torque of 1 kg, 1 kg m or 1 kg m^2
      if (found.cwiseAbs().maxCoeff() < kRounding) continue;  // the difference of nothing
      EXPECT_LT(error, kTolerance) << parameters[k] << " of link " << link;
    }
  }
}

TEST_P(RobotTangents, WhatALevelBaseHidesShowsWhereItIsTilted) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  std::size_t first = 0;
  while (own.robot.model.joints[first].coordinate < 0) ++first;
  constexpr std::size_t kMX = 6;
  NumericRobot heavier = own.twin;
  heavier.joints[first].inertial[kMX] += 1;
  long double changed = 0, largest = 0;
  for (Index k = 0; k < kSamples; ++k) {
    const Values before = own.torque(own.twin, k), after = own.torque(heavier, k);
    for (std::size_t j = 0; j < before.size(); ++j) {
      changed = std::max(changed, std::abs(after[j] - before[j]));
      largest = std::max(largest, std::abs(before[j]));
    }
  }
  const bool hidden = changed < 1e-9L * largest;
  const std::string names[] = {"hidden_gx", "hidden_gy"};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const MatrixXd found = tangent(names[axis], 0, own.motion, own.beta);
    if (!hidden) {
      EXPECT_TRUE(found.isZero(0)) << names[axis];
      continue;
    }
    test::RelativeError error;
    for (Index k = 0; k < kSamples; ++k) {
      NumericRobot tilted = own.twin, both = heavier;
      tilted.base_acceleration[axis] += 1;
      both.base_acceleration[axis] += 1;
      const Values light = own.torque(tilted, k), heavy = own.torque(both, k);
      for (std::size_t j = 0; j < light.size(); ++j) {
        const int row = own.robot.model.joints[j].coordinate;
        if (row >= 0) error.add(found(k, row), heavy[j] - light[j]);
      }
    }
    EXPECT_LT(error.value(), kTolerance) << names[axis];
    EXPECT_GT(found.cwiseAbs().maxCoeff(), 0.1) << names[axis];
  }
}

TEST_P(RobotTangents, ByTheMotionAreDifferencesOfTheTorque) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  constexpr double kStep = 1e-5;
  const std::pair<const char*, MatrixXd JointMotion::*> parts[] = {
      {"d_q", &JointMotion::q}, {"d_qd", &JointMotion::dq}, {"d_qdd", &JointMotion::ddq}};
  for (const auto& [name, part] : parts) {
    for (int link = 1; link <= own.robot.model.size(); ++link) {
      const int coordinate = own.robot.model.joint(link).coordinate;
      if (coordinate < 0) continue;
      const MatrixXd found = tangent(name, link, own.motion, own.beta);
      TangentCase more = own, less = own;
      (more.motion.*part).col(coordinate).array() += kStep;
      (less.motion.*part).col(coordinate).array() -= kStep;
      test::RelativeError error;
      bool any = false;
      for (Index k = 0; k < kSamples; ++k) {
        const Values above = more.torque(own.twin, k), below = less.torque(own.twin, k);
        for (std::size_t j = 0; j < own.twin.size(); ++j) {
          const int row = own.robot.model.joints[j].coordinate;
          if (row < 0) continue;
          const long double slope = (above[j] - below[j]) / (2 * kStep);
          any = any || std::abs(slope) > 1e-9L;
          error.add(found(k, row), slope);
        }
      }
      if (any) {
        EXPECT_LT(error.value(), kTolerance) << name << " of link " << link;
      } else {
        EXPECT_LT(found.cwiseAbs().maxCoeff(), 1e-9) << name << " of link " << link;
      }
    }
  }
}

TEST_P(RobotTangents, FurtherOnAreThoseOfARobotThatIsSo) {
  constexpr double kFurther = 0.2;
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  const std::pair<const char*, double NumericJoint::*> constants[] = {
      {"d_alpha", &NumericJoint::alpha},
      {"d_d", &NumericJoint::d},
      {"d_theta", &NumericJoint::theta},
      {"d_r", &NumericJoint::r}};
  for (int link = 1; link <= own.robot.model.size(); ++link) {
    for (const auto& [name, constant] : constants) {
      TangentCase there = own;
      there.twin.joints[static_cast<std::size_t>(link - 1)].*constant += kFurther;
      const MatrixXd found = tangent(name, link, own.motion, own.beta, kFurther);
      const auto step = [&, at = constant](NumericRobot& robot, double size) {
        robot.joints[static_cast<std::size_t>(link - 1)].*at += size;
      };
      if (found.cwiseAbs().maxCoeff() < 1e-9) continue;
      EXPECT_LT(error_of(there, found, step), kTolerance) << name << " of link " << link;
    }
    const int coordinate = own.robot.model.joint(link).coordinate;
    if (coordinate < 0) continue;
    JointMotion there = own.motion;
    there.q.col(coordinate).array() += kFurther;
    EXPECT_EQ(tangent("d_q", link, own.motion, own.beta, kFurther),
              tangent("d_q", link, there, own.beta))
        << link;
  }
}

TEST_P(RobotTangents, OfOneProgramComeTogether) {
  const TangentCase own(GetParam());
  const TangentFunction tangents = robot_tangents(own.robot);
  std::size_t moving = 0;
  for (const JointModel& joint : own.robot.model.joints) moving += joint.coordinate >= 0 ? 1 : 0;
  const int first = own.robot.model.joint(1).coordinate >= 0 ? 1 : 2;
  EXPECT_EQ(tangents({"d_q", first}, own.motion, own.beta, 0).size(), 3 * moving);
  EXPECT_EQ(tangents({"d_gx", 0}, own.motion, own.beta, 0).size(), 3u);
  EXPECT_EQ(tangents({"payload_M", 0}, own.motion, own.beta, 0).size(), 10u);
  EXPECT_EQ(tangents({"contact_fx", first}, own.motion, own.beta, 0).size(), 6u);
  EXPECT_EQ(tangents({"wrench_nz", 0}, own.motion, own.beta, 0).size(), 6u);
  EXPECT_THROW(tangents({"wrench_mz", 0}, own.motion, own.beta, 0), std::invalid_argument);
  EXPECT_THROW(tangents({"d_q", 99}, own.motion, own.beta, 0), std::invalid_argument);
}

TEST_P(RobotTangents, OfAForceAreDifferencesOfItsPath) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  const std::string axes[] = {"fx", "fy", "fz"};
  constexpr long double kStep = 1e-5L;
  for (int link = 1; link <= own.robot.model.size(); ++link) {
    for (int axis = 0; axis < 3; ++axis) {
      const MatrixXd found = tangent("contact_" + axes[axis], link, own.motion, own.beta);
      double worst = 0;
      for (Index k = 0; k < kSamples; ++k) {
        for (std::size_t j = 0; j < own.twin.size(); ++j) {
          const int coordinate = own.robot.model.joints[j].coordinate;
          if (coordinate < 0) continue;
          Values more = own.per_joint(own.motion.q, k), less = more;
          more[j] += kStep;
          less[j] -= kStep;
          const auto at = static_cast<std::size_t>(link - 1);
          const long double slope = (test::forward_kinematics(own.twin, more)[at](axis, 3) -
                                     test::forward_kinematics(own.twin, less)[at](axis, 3)) /
                                    (2 * kStep);
          worst = std::max(worst, std::abs(found(k, coordinate) - static_cast<double>(slope)));
        }
      }
      EXPECT_LT(worst, kTolerance) << axes[axis] << " on link " << link;
    }
  }
}

/// The judge's robot with a joint of the given kind along an axis of link j's frame, behind it.
NumericRobot with_joint_along(const NumericRobot& robot, std::size_t j, int axis, int sigma) {
  const double right = std::numbers::pi / 2;
  const auto row = [](int kind, double alpha, double theta) {
    NumericJoint joint;
    joint.sigma = kind;
    joint.alpha = alpha;
    joint.theta = theta;
    return joint;
  };
  std::vector<NumericJoint> path;  // from the frame of j back to its orientation
  if (axis == 0) {
    path = {row(2, right, right), row(sigma, right, 0), row(2, right, right), row(2, right, 0)};
  } else if (axis == 1) {
    path = {row(sigma, -right, 0), row(2, right, 0)};
  } else {
    path = {row(sigma, 0, 0)};
  }
  NumericRobot result = robot;
  const auto added = static_cast<int>(path.size());
  NumericJoint& own = result.joints[j];
  path.back().inertial = own.inertial;
  own.inertial = {};
  for (std::size_t i = j + 1; i < result.joints.size(); ++i) {
    if (result.joints[i].parent > static_cast<int>(j)) result.joints[i].parent += added;
  }
  for (int i = 0; i < added; ++i) {
    path[static_cast<std::size_t>(i)].parent = static_cast<int>(j) + 1 + i;
  }
  result.joints.insert(result.joints.begin() + static_cast<std::ptrdiff_t>(j) + 1, path.begin(),
                       path.end());
  return result;
}

// a search knows them ahead by a parabola: as far as positions are wrong
TEST_P(RobotTangents, AheadAreOnAParabolaForTheSignals) {
  const TangentCase own(GetParam());
  const Tangent tangent(own);
  EffectRecordings data;
  data.model = own.robot.linear;
  data.robot = effect_robot(own.robot);
  data.runs.emplace_back();
  Motion& motion = data.runs[0].motion;
  motion.time = VectorXd::LinSpaced(kSamples, 0, kSamples - 1);
  motion.q = own.motion.q;
  motion.dq = own.motion.dq;
  motion.ddq = own.motion.ddq;
  EffectSignals signals(data);
  signals.set_beta(own.beta);
  const JointModel& joint = own.robot.model.joint(2);
  EffectInstance effect;
  effect.law.variables = {"d_q", "d_qd", "d_qdd", "d_alpha", "d_d"};
  effect.law.parameters.emplace_back().name = "error";
  effect.law.midpoint = 0;
  effect.link = 2;
  effect.joint = joint.coordinate;
  const auto check = [&](double further, double most) {
    effect.parameters = VectorXd::Constant(1, 2 * further);
    for (int target = 0; target < data.joints(); ++target) {
      const MatrixXd found = signals.variables(0, effect, target);
      for (Index v = 0; v < found.cols(); ++v) {
        const std::string& name = effect.law.variables[static_cast<std::size_t>(v)];
        const MatrixXd exact = tangent(name, 2, own.motion, own.beta, further);
        const double size = std::max(exact.cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((found.col(v) - exact.col(target)).cwiseAbs().maxCoeff(), most * size)
            << name << " " << further;
      }
    }
  };
  check(0, 1e-12);
  check(0.05, 1e-9);  // a point of the parabola
  check(-0.05, 1e-9);
  check(0.01, 1e-3);
  check(0.15, 1e-2);
}

TEST(RobotTangents, OfAWrenchAreTorquesOfJointsAlongItsAxes) {
  // modified frames: a joint that is put behind link j stands in its frame
  const TangentCase own("tests/robots/ur10e_oracle.robot");
  const Tangent tangent(own);
  const std::string names[] = {"fx", "fy", "fz", "nx", "ny", "nz"};
  for (int component = 0; component < 6; ++component) {
    const MatrixXd found = tangent("wrench_" + names[component], 0, own.motion, own.beta);
    test::RelativeError error;
    for (std::size_t j = 0; j < own.twin.size(); ++j) {
      const int axis = component % 3;
      const NumericRobot longer = with_joint_along(own.twin, j, axis, component < 3 ? 1 : 0);
      const std::size_t added = longer.size() - own.twin.size();
      const std::size_t joint = axis == 0 ? j + 2 : j + 1;  // the row that moves
      for (Index k = 0; k < kSamples; ++k) {
        const auto stretched = [&](const MatrixXd& part) {
          Values values = own.per_joint(part, k);
          values.insert(values.begin() + static_cast<std::ptrdiff_t>(j) + 1, added, 0.0L);
          return values;
        };
        const Values torque = test::id_rigid(longer, stretched(own.motion.q),
                                             stretched(own.motion.dq), stretched(own.motion.ddq));
        error.add(found(k, static_cast<Index>(j)), torque[joint]);
      }
    }
    EXPECT_LT(error.value(), 1e-10) << names[component];
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, RobotTangents, testing::ValuesIn(kRobots),
                         [](const testing::TestParamInfo<const char*>& own) {
                           std::string name = own.param;
                           name = name.substr(name.rfind('/') + 1);
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace dyngen::runtime
