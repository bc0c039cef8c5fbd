// SPDX-License-Identifier: MIT
#include "tests/gen/robot_input/description_text.h"

#include <fmt/format.h>

#include <numbers>
#include <random>

namespace dyngen::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Matrix3d turn_of(const Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy[2], Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy[1], Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

Isometry3d pose_of(const Vector3d& xyz, const Vector3d& rpy) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = turn_of(rpy);
  pose.translation() = xyz;
  return pose;
}

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed), seed_(seed) {}

  std::vector<MadeLink> make() {
    const int links = 3 + pick(7);
    std::vector<MadeLink> result;
    int moving = 0;
    for (int i = 0; i < links; ++i) {
      MadeLink link;
      link.name = fmt::format("link{}", i);
      link.joint = fmt::format("joint{}", i);
      if (i > 0) {
        link.parent = seed_ % 3 == 0 ? i - 1 : pick(i);  // every third robot is a chain
        const int kind = pick(10);
        link.type = kind < 6 ? 0 : kind < 8 ? 1 : 2;
        if (i + 1 == links && moving == 0) link.type = 0;
        moving += link.type == 2 ? 0 : 1;
        link.continuous = link.type == 0 && pick(4) == 0;
        link.xyz = length3();
        link.rpy = angle3();
        link.axis = axis();
      }
      link.mass = i == 0 || (link.type == 2 && pick(2) == 0) ? 0 : number(0.2, 8);
      if (link.mass > 0) {
        link.centre = number(0, 1) < 0.2 ? Vector3d(0, 0, number(-0.2, 0.2)) : length3();
        link.turn = pick(2) == 0 ? Vector3d(0, 0, 0) : angle3();
        const Vector3d s(number(0.01, 0.2), number(0.01, 0.2), number(0.01, 0.2));
        // a box: sums of two squares
        link.inertia = Vector3d(s[1] * s[1] + s[2] * s[2], s[0] * s[0] + s[2] * s[2],
                                s[0] * s[0] + s[1] * s[1])
                           .asDiagonal();
        link.inertia *= link.mass / 3;
        if (pick(2) == 0) {
          const Matrix3d R = turn_of({number(-1, 1), number(-1, 1), number(-1, 1)});
          link.inertia = R * link.inertia * R.transpose();
          link.inertia = (0.5 * (link.inertia + link.inertia.transpose())).eval();
        }
      }
      if (link.type != 2 && pick(2) == 0) link.damping = number(0, 2);
      if (link.type != 2 && pick(2) == 0) link.friction = number(0, 2);
      result.push_back(link);
    }
    return result;
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() % 1000003) / 1000002;
  }
  Vector3d length3() {
    Vector3d result;
    for (int k = 0; k < 3; ++k) {
      const int kind = pick(4);
      result[k] = kind == 0 ? 0 : kind == 1 ? 0.05 * pick(10) : number(-0.5, 0.5);
    }
    return result;
  }
  Vector3d angle3() {
    Vector3d result;
    for (int k = 0; k < 3; ++k) {
      const int kind = pick(4);
      result[k] = kind == 0   ? 0
                  : kind == 1 ? kPi / 2 * (pick(5) - 2)
                  : kind == 2 ? kPi / 12 * (pick(24) - 12)
                              : number(-3, 3);
      if (pick(40) == 0) result[k] = 1e-3 * number(-1, 1);  // nearly parallel axes
    }
    return result;
  }
  Vector3d axis() {
    const int kind = pick(3);
    if (kind == 2) return {number(-1, 1), number(-1, 1), number(0.1, 1)};
    Vector3d result = Vector3d::Zero();
    result[pick(3)] = pick(2) == 0 ? 1 : -1;
    return result;
  }

  std::mt19937 random_;
  unsigned seed_;
};

std::string words(const Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

/// Motion of a link in the root's frame.
struct Moved {
  Isometry3d frame = Isometry3d::Identity();
  Vector3d axis = Vector3d::Zero();  ///< of its joint
  Vector3d w = Vector3d::Zero(), dw = Vector3d::Zero();
  Vector3d v = Vector3d::Zero(), a = Vector3d::Zero();  ///< of the frame's origin
};

std::vector<Moved> moved(const std::vector<MadeLink>& links, const std::vector<double>& q,
                         const std::vector<double>& dq, const std::vector<double>& ddq) {
  std::vector<Moved> all(links.size());
  std::size_t coordinate = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].parent < 0) continue;
    const Moved& parent = all[static_cast<std::size_t>(links[i].parent)];
    Moved& own = all[i];
    own.frame = parent.frame * pose_of(links[i].xyz, links[i].rpy);
    own.axis = own.frame.linear() * links[i].axis.normalized();
    own.w = parent.w;
    own.dw = parent.dw;
    double speed = 0, acceleration = 0;
    if (links[i].type == 1) {
      own.frame.translation() += q[coordinate] * own.axis;
      speed = dq[coordinate];
      acceleration = ddq[coordinate];
    }
    const Vector3d arm = own.frame.translation() - parent.frame.translation();
    own.v = parent.v + parent.w.cross(arm) + speed * own.axis;
    own.a = parent.a + parent.dw.cross(arm) + parent.w.cross(parent.w.cross(arm)) +
            2 * speed * parent.w.cross(own.axis) + acceleration * own.axis;
    if (links[i].type == 0) {
      own.frame.linear() =
          Eigen::AngleAxisd(q[coordinate], own.axis).toRotationMatrix() * own.frame.linear();
      own.w += dq[coordinate] * own.axis;
      own.dw += ddq[coordinate] * own.axis + parent.w.cross(dq[coordinate] * own.axis);
    }
    if (links[i].type != 2) ++coordinate;
  }
  return all;
}

}  // namespace

std::vector<MadeLink> made_robot(unsigned seed) { return Maker(seed).make(); }

std::string urdf_of(const std::vector<MadeLink>& links) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"made\">\n";
  for (const MadeLink& link : links) {
    text += fmt::format("  <link name=\"{}\">\n", link.name);
    if (link.mass > 0) {
      const Matrix3d& J = link.inertia;
      text += fmt::format(
          "    <inertial>\n      <origin xyz=\"{}\" rpy=\"{}\"/>\n      <mass value=\"{:.17g}\"/>\n"
          "      <inertia ixx=\"{:.17g}\" ixy=\"{:.17g}\" ixz=\"{:.17g}\" iyy=\"{:.17g}\" "
          "iyz=\"{:.17g}\" izz=\"{:.17g}\"/>\n    </inertial>\n",
          words(link.centre), words(link.turn), link.mass, J(0, 0), J(0, 1), J(0, 2), J(1, 1),
          J(1, 2), J(2, 2));
    }
    text += "  </link>\n";
  }
  for (const MadeLink& link : links) {
    if (link.parent < 0) continue;
    const char* type = link.type == 1    ? "prismatic"
                       : link.type == 2  ? "fixed"
                       : link.continuous ? "continuous"
                                         : "revolute";
    text += fmt::format(
        "  <joint name=\"{}\" type=\"{}\">\n    <origin xyz=\"{}\" rpy=\"{}\"/>\n"
        "    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n    <axis xyz=\"{}\"/>\n",
        link.joint, type, words(link.xyz), words(link.rpy),
        links[static_cast<std::size_t>(link.parent)].name, link.name, words(link.axis));
    if (link.type != 2) {
      if (!link.continuous) {
        text += "    <limit lower=\"-2\" upper=\"2.5\" effort=\"80\" velocity=\"3\"/>\n";
      }
      text += fmt::format("    <dynamics damping=\"{:.17g}\" friction=\"{:.17g}\"/>\n",
                          link.damping, link.friction);
    }
    text += "  </joint>\n";
  }
  return text + "</robot>\n";
}

std::vector<double> torques_of(const std::vector<MadeLink>& links, const std::vector<double>& q,
                               const std::vector<double>& dq, const std::vector<double>& ddq) {
  const std::vector<Moved> all = moved(links, q, dq, ddq);
  std::vector<Vector3d> force(links.size(), Vector3d::Zero()),
      moment(links.size(), Vector3d::Zero());
  for (std::size_t i = links.size(); i-- > 0;) {
    const Moved& own = all[i];
    const Vector3d centre = own.frame * links[i].centre;
    const Vector3d arm = centre - own.frame.translation();
    const Vector3d a = own.a + own.dw.cross(arm) + own.w.cross(own.w.cross(arm));
    const Matrix3d R = own.frame.linear() * turn_of(links[i].turn);
    const Matrix3d J = R * links[i].inertia * R.transpose();
    const Vector3d f = links[i].mass * (a + Vector3d(0, 0, 9.81));
    force[i] += f;
    moment[i] += arm.cross(f) + J * own.dw + own.w.cross(J * own.w);
    if (links[i].parent < 0) continue;
    const auto parent = static_cast<std::size_t>(links[i].parent);
    force[parent] += force[i];
    moment[parent] +=
        moment[i] + (own.frame.translation() - all[parent].frame.translation()).cross(force[i]);
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].type == 2) continue;
    const double speed = dq[result.size()];
    result.push_back((links[i].type == 0 ? moment[i] : force[i]).dot(all[i].axis) +
                     links[i].damping * speed);
  }
  return result;
}

Isometry3d frame_of(const std::vector<MadeLink>& links, const std::vector<double>& q, int link) {
  const std::vector<double> zero(q.size(), 0.0);
  return moved(links, q, zero, zero)[static_cast<std::size_t>(link)].frame;
}

std::vector<int> depth_first(const std::vector<MadeLink>& links) {
  std::vector<int> place(links.size(), -1);  // of moving links, in their own order
  int coordinate = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].type != 2) place[i] = coordinate++;
  }
  std::vector<int> order;
  const auto visit = [&](const auto& self, int link) -> void {
    if (place[static_cast<std::size_t>(link)] >= 0) {
      order.push_back(place[static_cast<std::size_t>(link)]);
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].parent == link) self(self, static_cast<int>(i));
    }
  };
  visit(visit, 0);
  return order;
}

}  // namespace dyngen::test
