// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/description_bodies.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "gen/symbols/exact.h"
#include "runtime/consistency/pseudo_inertia.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two descriptions are of one arm if their torques agree to this, of the largest torque: some
/// thousand times what rounding does in a chain of a few joints.
constexpr double kSameArm = 1e-9;
/// A parameter with less torque, of the largest, is none: rounding of the equations that it is
/// found by.
constexpr double kNoTorque = 1e-12;
/// States for each base parameter on which they are compared.
constexpr int kStatesPerParameter = 3;

Eigen::Matrix4d homogeneous(const RigidPose& pose) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (int k = 0; k < 3; ++k) {
      T(i, k) = static_cast<double>(pose.R[row][static_cast<std::size_t>(k)]);
    }
    T(i, 3) = static_cast<double>(pose.p[row]);
  }
  return T;
}

/// Ten parameters in one frame of those in another. @param T  of the other in the one
Eigen::Matrix<double, 10, 10> moved_parameters(const Eigen::Matrix4d& T) {
  Eigen::Matrix<double, 10, 10> map;
  for (int k = 0; k < 10; ++k) {
    const Eigen::Matrix4d J = pseudo_inertia(TenParameters::Unit(k));
    map.col(k) = ten_parameters(T * J * T.transpose());
  }
  return map;
}

TenParameters ten_of(const TreeBody& body) {
  const Real m = body.mass;
  const RealMatrix about = body.inertia + parallel_axes(m, body.centre);
  TenParameters ten;
  ten << static_cast<double>(about[0][0]), static_cast<double>(about[0][1]),
      static_cast<double>(about[0][2]), static_cast<double>(about[1][1]),
      static_cast<double>(about[1][2]), static_cast<double>(about[2][2]),
      static_cast<double>(m * body.centre[0]), static_cast<double>(m * body.centre[1]),
      static_cast<double>(m * body.centre[2]), static_cast<double>(m);
  return ten;
}

/// (states x n * nb) regressors of random motions, the samples of a joint below each other.
MatrixXd stacked_regressor(const LinearModel& model, const JointMotion& motion) {
  MatrixXd Y;
  model.regressor(motion.q, motion.dq, motion.ddq, Y);
  const Index N = motion.q.rows(), nb = model.size();
  MatrixXd rows(N * model.joints(), nb);
  for (int j = 0; j < model.joints(); ++j) rows.middleRows(j * N, N) = Y.middleCols(j * nb, nb);
  return rows;
}

JointMotion random_states(int joints, Index count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-2, 2);
  const auto fill = [&] {
    MatrixXd values(count, joints);
    for (Index k = 0; k < count; ++k) {
      for (Index j = 0; j < joints; ++j) values(k, j) = number(random);
    }
    return values;
  };
  JointMotion motion;
  motion.q = fill();
  motion.dq = fill();
  motion.ddq = fill();
  return motion;
}

[[noreturn]] void throw_other_arm(const std::string& description, const std::string& robot,
                                  const std::string& what) {
  throw ModelError(fmt::format(
      "{}: error: it does not describe the arm of {}: {}. Expected the same joints in the same "
      "order and the same lengths: 'dyngen {} --to-robot arm.robot' makes a robot file of it\n",
      description, robot, what, description));
}

}  // namespace

DescriptionModel description_model(const RobotSource& source) {
  DescriptionModel model;
  model.bodies = read_bodies(read_description(source.path), source);
  model.robot = describe_robot(read_robot_file(source), OpenParameters::kEverything);
  return model;
}

BodyGrouping body_grouping(const DescriptionModel& description, bool with_massless) {
  const ConvertedRobot& converted = description.bodies.robot;
  BodyGrouping result;
  struct Part {
    int body;
    MatrixXd columns;
  };
  std::vector<Part> parts;
  for (std::size_t row = 0; row < converted.rows.size(); ++row) {
    const DhRow& link = converted.rows[row];
    if (link.use != DhRowUse::kJoint) continue;
    const MatrixXd own = description.robot.grouping.middleCols<10>(static_cast<Index>(kChiCount) *
                                                                   static_cast<Index>(row));
    const auto& group = converted.robot.groups[static_cast<std::size_t>(link.group)];
    for (const GroupedBody& member : group.bodies) {
      const TreeBody& body = converted.tree.bodies[static_cast<std::size_t>(member.body)];
      if (!body.has_inertial && !with_massless) continue;
      const RigidPose in_row = inverse(link.frame) * member.pose;
      parts.push_back({member.body, own * moved_parameters(homogeneous(in_row))});
    }
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.body < b.body; });
  const Index nb = description.robot.grouping.rows();
  result.K.resize(nb, 10 * static_cast<Index>(parts.size()));
  result.prior.resize(result.K.cols());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const TreeBody& body = converted.tree.bodies[static_cast<std::size_t>(parts[i].body)];
    const Index place = 10 * static_cast<Index>(i);
    result.bodies.push_back(parts[i].body);
    result.K.middleCols<10>(place) = parts[i].columns;
    if (body.has_inertial) {
      result.prior.segment<10>(place) = ten_of(body);
    } else {
      result.prior.segment<10>(place).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return result;
}

VectorXd in_base_parameters_of(const DescriptionModel& description, const DescribedRobot& robot,
                               const StandardParameters& standard) {
  const LinearModel& own = description.robot.linear;
  const std::string& file = description.bodies.document.file_name;
  const std::string& other = robot.file.file_name;
  if (own.revolute != robot.linear.revolute) {
    throw_other_arm(file, other,
                    fmt::format("{} and {} moving joints, or of other kinds", own.joints(),
                                robot.linear.joints()));
  }
  const VectorXd beta = robot.grouping * standard;
  const Index count = kStatesPerParameter * std::max<Index>(own.size(), robot.linear.size());
  const JointMotion motion = random_states(own.joints(), count);
  const MatrixXd W = stacked_regressor(own, motion);
  const VectorXd tau = stacked_regressor(robot.linear, motion) * beta;
  const VectorXd found = W.colPivHouseholderQr().solve(tau);
  const VectorXd error = (W * found - tau).cwiseAbs();
  Index worst = 0;
  const double largest = error.size() > 0 ? error.maxCoeff(&worst) : 0;
  if (largest > kSameArm * tau.lpNorm<Eigen::Infinity>()) {
    const int joint = static_cast<int>(worst / count);
    throw_other_arm(file, other,
                    fmt::format("torque of joint {} ({}) differs by up to {:.3g} {}", joint + 1,
                                own.joint_names[static_cast<std::size_t>(joint)], largest,
                                own.revolute[static_cast<std::size_t>(joint)] ? "N m" : "N"));
  }
  // what rounding has left of a parameter that the arm does not have
  const double least = kNoTorque * tau.lpNorm<Eigen::Infinity>();
  VectorXd clean = found;
  for (Index i = 0; i < clean.size(); ++i) {
    if (std::abs(clean[i]) * W.col(i).lpNorm<Eigen::Infinity>() < least) clean[i] = 0;
  }
  return clean;
}

double torque_difference(const LinearModel& model, const VectorXd& one, const VectorXd& other) {
  if (model.size() == 0) return 0;
  const MatrixXd W =
      stacked_regressor(model, random_states(model.joints(), kStatesPerParameter * model.size()));
  const double size =
      std::max((W * one).lpNorm<Eigen::Infinity>(), (W * other).lpNorm<Eigen::Infinity>());
  return size > 0 ? (W * (one - other)).lpNorm<Eigen::Infinity>() / size : 0;
}

StandardParameters numbers_of(const RobotModel& model) {
  StandardParameters values =
      StandardParameters::Zero(static_cast<Index>(kChiCount) * model.size());
  for (int j = 1; j <= model.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Quantity& quantity = model.joint(j).chi[k];
      if (quantity.unknown) continue;
      values[static_cast<Index>(kChiCount) * (j - 1) + static_cast<Index>(k)] =
          to_double(quantity.value);
    }
  }
  return values;
}

}  // namespace dyngen::runtime
