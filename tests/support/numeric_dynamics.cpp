// SPDX-License-Identifier: MIT
#include "tests/support/numeric_dynamics.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace dyngen::test {
namespace {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
/// Motion: angular velocity, then velocity of the body's point at the origin of frame 0.
/// Force: moment about the origin of frame 0, then force.
template <typename Scalar>
using Spatial = Eigen::Matrix<Scalar, 6, 1>;
template <typename Scalar>
using SpatialMatrix = Eigen::Matrix<Scalar, 6, 6>;

template <typename Scalar>
Matrix3<Scalar> cross_matrix(const Vector3<Scalar>& v) {
  Matrix3<Scalar> result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

template <typename Scalar>
Transform<Scalar> about_z(Scalar angle, Scalar shift) {
  Transform<Scalar> result = Transform<Scalar>::Identity();
  const Scalar c = std::cos(angle);
  const Scalar s = std::sin(angle);
  result.template topLeftCorner<2, 2>() << c, -s, s, c;
  result(2, 3) = shift;
  return result;
}

template <typename Scalar>
Transform<Scalar> about_x(Scalar angle, Scalar shift) {
  Transform<Scalar> result = Transform<Scalar>::Identity();
  const Scalar c = std::cos(angle);
  const Scalar s = std::sin(angle);
  result.template block<2, 2>(1, 1) << c, -s, s, c;
  result(0, 3) = shift;
  return result;
}

void check_robot(const NumericRobot& robot) {
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const NumericJoint& joint = robot.joints[i];
    if (joint.sigma < 0 || joint.sigma > 2) {
      throw std::invalid_argument("joint " + std::to_string(i + 1) + ": sigma is " +
                                  std::to_string(joint.sigma) + ", expected 0, 1 or 2");
    }
    if (joint.parent < 0 || joint.parent > static_cast<int>(i)) {
      throw std::invalid_argument("joint " + std::to_string(i + 1) + ": parent is " +
                                  std::to_string(joint.parent) + ", expected 0.." +
                                  std::to_string(i));
    }
  }
}

void check_size(const NumericRobot& robot, std::size_t size, const char* name) {
  if (size != robot.size()) {
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(size) +
                                " entries, the robot " + std::to_string(robot.size()) + " joints");
  }
}

template <typename Scalar>
Transform<Scalar> parent_frame(const std::vector<Transform<Scalar>>& frames, int parent) {
  return parent == 0 ? Transform<Scalar>(Transform<Scalar>::Identity())
                     : frames[static_cast<std::size_t>(parent - 1)];
}

/// Screw of joint i in frame 0: the motion of its link per unit of dq.
template <typename Scalar>
Spatial<Scalar> joint_screw(const NumericRobot& robot, std::size_t i,
                            const std::vector<Transform<Scalar>>& frames) {
  const NumericJoint& joint = robot.joints[i];
  // The axis is z of the link's own frame (modified) or of the frame before it (standard).
  const Transform<Scalar> frame = robot.standard ? parent_frame(frames, joint.parent) : frames[i];
  const Vector3<Scalar> axis = frame.template block<3, 1>(0, 2);
  const Vector3<Scalar> point = frame.template block<3, 1>(0, 3);
  Spatial<Scalar> screw = Spatial<Scalar>::Zero();
  if (joint.sigma == 0) {
    screw << axis, point.cross(axis);
  } else if (joint.sigma == 1) {
    screw.template tail<3>() = axis;
  }
  return screw;
}

/// Spatial inertia of a link in frame 0: X^T I X, with X taking motions to the link's frame.
/// [Featherstone 2008, eqs. 2.24, 2.63 and 2.66; first moments written for mass times centre]
template <typename Scalar>
SpatialMatrix<Scalar> spatial_inertia(const std::array<double, 10>& p,
                                      const Transform<Scalar>& frame) {
  const Vector3<Scalar> moment(p[6], p[7], p[8]);
  const Matrix3<Scalar> h = cross_matrix<Scalar>(moment);
  SpatialMatrix<Scalar> inertia = SpatialMatrix<Scalar>::Zero();
  inertia.template topLeftCorner<3, 3>() << p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5];
  inertia.template topRightCorner<3, 3>() = h;
  inertia.template bottomLeftCorner<3, 3>() = h.transpose();
  inertia.template bottomRightCorner<3, 3>().diagonal().setConstant(p[9]);

  const Matrix3<Scalar> to_link = frame.template topLeftCorner<3, 3>().transpose();
  const Vector3<Scalar> origin = frame.template block<3, 1>(0, 3);
  SpatialMatrix<Scalar> X = SpatialMatrix<Scalar>::Zero();
  X.template topLeftCorner<3, 3>() = to_link;
  X.template bottomLeftCorner<3, 3>() = -to_link * cross_matrix<Scalar>(origin);
  X.template bottomRightCorner<3, 3>() = to_link;
  return X.transpose() * inertia * X;
}

/// v x: the rate of change of a motion vector that moves with v; its negative transpose is v x*.
template <typename Scalar>
SpatialMatrix<Scalar> motion_cross(const Spatial<Scalar>& v) {
  SpatialMatrix<Scalar> result = SpatialMatrix<Scalar>::Zero();
  const Matrix3<Scalar> w = cross_matrix<Scalar>(v.template head<3>());
  result.template topLeftCorner<3, 3>() = w;
  result.template bottomLeftCorner<3, 3>() = cross_matrix<Scalar>(v.template tail<3>());
  result.template bottomRightCorner<3, 3>() = w;
  return result;
}

template <typename Scalar>
Scalar sign(Scalar x) {
  return static_cast<Scalar>((x > 0) - (x < 0));
}

template <typename Scalar>
std::vector<Scalar> zeros(const NumericRobot& robot) {
  return std::vector<Scalar>(robot.size(), Scalar(0));
}

}  // namespace

template <typename Scalar>
std::vector<Transform<Scalar>> forward_kinematics(const NumericRobot& robot,
                                                  const std::vector<Scalar>& q) {
  check_robot(robot);
  check_size(robot, q.size(), "q");
  std::vector<Transform<Scalar>> frames;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const NumericJoint& joint = robot.joints[i];
    const Scalar angle = Scalar(joint.theta) + (joint.sigma == 0 ? q[i] : Scalar(0));
    const Scalar shift = Scalar(joint.r) + (joint.sigma == 1 ? q[i] : Scalar(0));
    const Transform<Scalar> z = about_z<Scalar>(angle, shift);
    const Transform<Scalar> x = about_x<Scalar>(Scalar(joint.alpha), Scalar(joint.d));
    const Transform<Scalar> before = parent_frame(frames, joint.parent);
    frames.push_back(robot.standard ? Transform<Scalar>(before * z * x)
                                    : Transform<Scalar>(before * x * z));
  }
  return frames;
}

template <typename Scalar>
std::vector<Scalar> id_rigid(const NumericRobot& robot, const std::vector<Scalar>& q,
                             const std::vector<Scalar>& dq, const std::vector<Scalar>& ddq) {
  const std::vector<Transform<Scalar>> frames = forward_kinematics(robot, q);
  check_size(robot, dq.size(), "dq");
  check_size(robot, ddq.size(), "ddq");
  const std::size_t n = robot.size();

  // Gravity acts as if the base accelerated by -g.
  Spatial<Scalar> base = Spatial<Scalar>::Zero();
  for (int k = 0; k < 3; ++k) {
    base[k + 3] = Scalar(robot.base_acceleration[static_cast<std::size_t>(k)]);
  }
  std::vector<Spatial<Scalar>> s(n), v(n), a(n), f(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int parent = robot.joints[i].parent;
    const bool on_base = parent == 0;
    const std::size_t p = on_base ? 0 : static_cast<std::size_t>(parent - 1);
    const Spatial<Scalar> v_parent = on_base ? Spatial<Scalar>(Spatial<Scalar>::Zero()) : v[p];
    const Spatial<Scalar> a_parent = on_base ? base : a[p];
    const bool moves = robot.joints[i].sigma != 2;
    const Scalar dq_i = moves ? dq[i] : Scalar(0);
    const Scalar ddq_i = moves ? ddq[i] : Scalar(0);
    s[i] = joint_screw(robot, i, frames);  // zero for a fixed joint
    v[i] = v_parent + s[i] * dq_i;
    a[i] = a_parent + s[i] * ddq_i + motion_cross<Scalar>(v[i]) * s[i] * dq_i;
    const SpatialMatrix<Scalar> I = spatial_inertia<Scalar>(robot.joints[i].inertial, frames[i]);
    f[i] = I * a[i] - motion_cross<Scalar>(v[i]).transpose() * (I * v[i]);
  }
  std::vector<Scalar> tau(n);
  for (std::size_t i = n; i-- > 0;) {
    tau[i] = s[i].dot(f[i]);
    const int parent = robot.joints[i].parent;
    if (parent != 0) f[static_cast<std::size_t>(parent - 1)] += f[i];
  }
  return tau;
}

template <typename Scalar>
std::vector<Scalar> id(const NumericRobot& robot, const std::vector<Scalar>& q,
                       const std::vector<Scalar>& dq, const std::vector<Scalar>& ddq) {
  std::vector<Scalar> tau = id_rigid(robot, q, dq, ddq);
  const std::vector<Scalar> extra = friction(robot, dq);
  for (std::size_t i = 0; i < robot.size(); ++i) {
    if (robot.joints[i].sigma == 2) continue;
    tau[i] += Scalar(robot.joints[i].IA) * ddq[i] + extra[i];
  }
  return tau;
}

template <typename Scalar>
std::vector<Scalar> gravity(const NumericRobot& robot, const std::vector<Scalar>& q) {
  return id_rigid(robot, q, zeros<Scalar>(robot), zeros<Scalar>(robot));
}

template <typename Scalar>
std::vector<Scalar> coriolis(const NumericRobot& robot, const std::vector<Scalar>& q,
                             const std::vector<Scalar>& dq) {
  NumericRobot weightless = robot;
  weightless.base_acceleration = {};
  return id_rigid(weightless, q, dq, zeros<Scalar>(robot));
}

template <typename Scalar>
std::vector<Scalar> friction(const NumericRobot& robot, const std::vector<Scalar>& dq) {
  check_robot(robot);
  check_size(robot, dq.size(), "dq");
  std::vector<Scalar> tau = zeros<Scalar>(robot);
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const NumericJoint& joint = robot.joints[i];
    if (joint.sigma == 2) continue;
    tau[i] = Scalar(joint.Fs) * sign(dq[i]) + Scalar(joint.Fv) * dq[i] + Scalar(joint.off);
  }
  return tau;
}

template <typename Scalar>
SquareMatrix<Scalar> rigid_mass_matrix(const NumericRobot& robot, const std::vector<Scalar>& q) {
  NumericRobot weightless = robot;
  weightless.base_acceleration = {};
  const auto n = static_cast<Eigen::Index>(robot.size());
  SquareMatrix<Scalar> M(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<Scalar> unit = zeros<Scalar>(robot);
    unit[static_cast<std::size_t>(j)] = 1;
    const std::vector<Scalar> column = id_rigid(weightless, q, zeros<Scalar>(robot), unit);
    for (Eigen::Index i = 0; i < n; ++i) M(i, j) = column[static_cast<std::size_t>(i)];
  }
  return M;
}

template <typename Scalar>
SquareMatrix<Scalar> mass_matrix(const NumericRobot& robot, const std::vector<Scalar>& q) {
  SquareMatrix<Scalar> M = rigid_mass_matrix(robot, q);
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (robot.joints[i].sigma != 2) M(k, k) += Scalar(robot.joints[i].IA);
  }
  return M;
}

using Robot = const NumericRobot&;

using Doubles = std::vector<double>;
template std::vector<Transform<double>> forward_kinematics(Robot, const Doubles&);
template Doubles id_rigid(Robot, const Doubles&, const Doubles&, const Doubles&);
template Doubles id(Robot, const Doubles&, const Doubles&, const Doubles&);
template Doubles gravity(Robot, const Doubles&);
template Doubles coriolis(Robot, const Doubles&, const Doubles&);
template Doubles friction(Robot, const Doubles&);
template SquareMatrix<double> rigid_mass_matrix(Robot, const Doubles&);
template SquareMatrix<double> mass_matrix(Robot, const Doubles&);

using LongDoubles = std::vector<long double>;
template std::vector<Transform<long double>> forward_kinematics(Robot, const LongDoubles&);
template LongDoubles id_rigid(Robot, const LongDoubles&, const LongDoubles&, const LongDoubles&);
template LongDoubles id(Robot, const LongDoubles&, const LongDoubles&, const LongDoubles&);
template LongDoubles gravity(Robot, const LongDoubles&);
template LongDoubles coriolis(Robot, const LongDoubles&, const LongDoubles&);
template LongDoubles friction(Robot, const LongDoubles&);
template SquareMatrix<long double> rigid_mass_matrix(Robot, const LongDoubles&);
template SquareMatrix<long double> mass_matrix(Robot, const LongDoubles&);

}  // namespace dyngen::test
