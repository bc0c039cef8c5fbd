// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gen/robot_file/robot_file.h"

/// URDF and MJCF as dyngen and other engines read them: torques of states.
namespace dyngen::test {

/// Values by the names of joints.
using ByJoint = std::map<std::string, double>;

/// A robot that says torques, N m or N, of rad or m and their rates.
class TorqueRobot {
 public:
  virtual ~TorqueRobot() = default;
  [[nodiscard]] virtual ByJoint torque(const ByJoint& q, const ByJoint& dq,
                                       const ByJoint& ddq) const = 0;
};

/// What dyngen reads: torque without dry friction, springs included.
class OwnRobot : public TorqueRobot {
 public:
  OwnRobot(const std::string& text, const std::string& name);
  explicit OwnRobot(const RobotFile& file);
  ~OwnRobot() override;

  [[nodiscard]] std::vector<std::string> joints() const;
  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq,
                               const ByJoint& ddq) const override;

 private:
  [[nodiscard]] std::vector<double> values(const ByJoint& own) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// KDL's tree by ROS's parser of URDF, with gravity 9.81 m/s^2 along -z. KDL knows no friction.
/// @param damping  N m s/rad or N s/m of joints that have some
std::unique_ptr<TorqueRobot> kdl_robot(const std::string& urdf, const ByJoint& damping);

/// MuJoCo's own reading of a text; joint limits and dry friction are off.
std::unique_ptr<TorqueRobot> mujoco_robot(const std::string& text, const std::string& name);

/// MuJoCo 2.2.2 finds the principal axes of a tensor to some 1e-8, and of sums of solids worse.
inline constexpr double kMujocoAxes = 1e-6;

/// Torques of random states are the same.
/// @param tolerance  of the largest torque
void expect_same_torques(const OwnRobot& own, const TorqueRobot& peer, const std::string& what,
                         double tolerance = 1e-9);

}  // namespace dyngen::test
