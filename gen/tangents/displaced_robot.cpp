// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tangents/displaced_robot.h"

#include <algorithm>

namespace dyngen {
namespace {

using GiNaC::ex;

const ex& right_angle() {
  static const ex kRightAngle = GiNaC::Pi / 2;
  return kRightAngle;
}

/// A frame that carries nothing.
SymbolicLink bare_link(JointType type, int parent) {
  SymbolicLink link;
  link.type = type;
  link.parent = parent;
  link.chi.fill(0);
  return link;
}

/// Copies links one by one and puts others between them.
class Insertion {
 public:
  explicit Insertion(const SymbolicRobot& robot) : result_(robot) { result_.links.clear(); }

  int add(SymbolicLink link) {
    result_.links.push_back(std::move(link));
    return result_.size();
  }

  /// The new joint.
  int add_joint(JointType type, int parent, const ex& alpha) {
    SymbolicLink joint = bare_link(type, parent);
    joint.alpha = alpha;
    joint.name = "displacement";
    joint.coordinate = result_.coordinate_count;
    ++result_.coordinate_count;
    return add(std::move(joint));
  }

  /// A joint along the x axis of a frame. What follows it begins with one right angle of alpha
  /// more.
  int add_joint_along_x(JointType type, int parent) {
    SymbolicLink to = bare_link(JointType::kFixed, parent);
    to.alpha = to.theta = right_angle();
    const int joint = add_joint(type, add(std::move(to)), right_angle());
    SymbolicLink back = bare_link(JointType::kFixed, joint);
    back.alpha = back.theta = right_angle();
    return add(std::move(back));
  }

  SymbolicRobot take() { return std::move(result_); }

 private:
  SymbolicRobot result_;
};

/// The body of a link on a frame of its own; the link itself becomes bare.
SymbolicLink split_body(SymbolicLink& link, int parent) {
  SymbolicLink body = bare_link(JointType::kFixed, parent);
  body.chi = link.chi;
  body.tip_alpha = link.tip_alpha;
  body.tip_d = link.tip_d;
  link.chi.fill(0);
  link.tip_alpha = link.tip_d = 0;
  return body;
}

}  // namespace

SymbolicRobot displaced_robot(const SymbolicRobot& robot, int link, DhConstant constant,
                              bool standard) {
  const bool along_x = constant == DhConstant::kAlpha || constant == DhConstant::kD;
  const bool turns = constant == DhConstant::kAlpha || constant == DhConstant::kTheta;
  const JointType type = turns ? JointType::kRevolute : JointType::kPrismatic;
  Insertion insertion(robot);
  std::vector<int> place(robot.links.size() + 1, 0);  // where children of a link hang now
  for (int j = 1; j <= robot.size(); ++j) {
    SymbolicLink own = robot.link(j);
    int& carrier = place[static_cast<std::size_t>(j)];
    own.parent = place[static_cast<std::size_t>(own.parent)];
    if (j != link) {
      carrier = insertion.add(std::move(own));
    } else if (along_x && !standard) {
      own.parent = insertion.add_joint_along_x(type, own.parent);
      own.alpha += right_angle();
      carrier = insertion.add(std::move(own));
    } else if (along_x) {
      SymbolicLink body = split_body(own, 0);
      body.parent = insertion.add_joint_along_x(type, insertion.add(std::move(own)));
      body.alpha = right_angle();
      carrier = insertion.add(std::move(body));
    } else {
      SymbolicLink body = split_body(own, 0);
      body.parent = insertion.add_joint(type, insertion.add(std::move(own)), 0);
      carrier = insertion.add(std::move(body));
    }
  }
  return insertion.take();
}

}  // namespace dyngen
