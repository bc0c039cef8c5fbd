// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/moving_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dyngen {

int BodyTree::root() const {
  std::vector<bool> carried(bodies.size(), false);
  for (const TreeJoint& joint : joints) carried[static_cast<std::size_t>(joint.child)] = true;
  const auto found = std::find(carried.begin(), carried.end(), false);
  return static_cast<int>(found - carried.begin());
}

int BodyTree::body(const std::string& wanted) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == wanted) return static_cast<int>(i);
  }
  return -1;
}

namespace {

std::size_t body_index(int index) { return static_cast<std::size_t>(index); }

/// "a, b, c and 4 more"
std::string few_names(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) {
    text += (i == 0 ? "'" : ", '") + printable(names[i]) + "'";
  }
  if (names.size() > kShown) text += fmt::format(" and {} more", names.size() - kShown);
  return text;
}

class Grouping {
 public:
  Grouping(const BodyTree& tree, const TreePart& part, Diagnostics& diagnostics)
      : tree_(tree), part_(part), diagnostics_(diagnostics), at_body_(tree.bodies.size()) {
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
      at_body_[body_index(tree.joints[j].parent)].push_back(static_cast<int>(j));
      at_body_[body_index(tree.joints[j].child)].push_back(static_cast<int>(j));
    }
  }

  GroupedRobot run() {
    const int root = tree_.root();
    const int base = named(part_.base, "--base", root);
    const int tip = named(part_.tip, "--tip", -1);
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
    chain_ = tip >= 0;
    if (chain_) on_chain_ = path(base, tip);
    turn_gravity(root, base);
    robot_.groups.emplace_back();
    add_body(0, base, Pose{}, -1);
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
    for (MovingGroup& group : robot_.groups) weigh(group);
    if (robot_.groups.size() == 1) {
      diagnostics_.error(tree_.place.position, tree_.place.length, nothing_moves(tip));
      throw ModelError(diagnostics_.render());
    }
    if (!chain_ && base != root) warn_of_what_stands_above(base);
    if (chain_) set_tip(tip);
    return std::move(robot_);
  }

 private:
  int named(const std::string& name, std::string_view option, int otherwise) {
    if (name.empty()) return otherwise;
    const int body = tree_.body(name);
    if (body >= 0) return body;
    std::vector<std::string> names;
    for (const Body& own : tree_.bodies) names.push_back(own.name);
    diagnostics_.error(tree_.place.position, tree_.place.length,
                       fmt::format("{} '{}': there is no such link", option, printable(name)),
                       "the links are " + few_names(names));
    return -1;
  }

  [[nodiscard]] std::string nothing_moves(int tip) const {
    if (tree_.joints.empty()) {
      return fmt::format(
          "the robot is one link and has no joints: a model of its dynamics needs "
          "a joint that moves ({} link '{}')",
          tree_.format, printable(tree_.bodies.front().name));
    }
    if (tip >= 0) return "no joint moves between --base and --tip";
    return "no joint moves: all joints that hang on the base are fixed";
  }

  /// The joints between two bodies, each true.
  std::vector<bool> path(int from, int to) {
    std::vector<int> reached_by(tree_.bodies.size(), -2);
    reached_by[body_index(from)] = -1;
    std::vector<int> open = {from};
    for (std::size_t next = 0; next < open.size(); ++next) {
      for (const int j : at_body_[body_index(open[next])]) {
        const int other = across(j, open[next]);
        if (reached_by[body_index(other)] != -2) continue;
        reached_by[body_index(other)] = j;
        open.push_back(other);
      }
    }
    std::vector<bool> on(tree_.joints.size(), false);
    for (int body = to; body != from; body = across(reached_by[body_index(body)], body)) {
      on[body_index(reached_by[body_index(body)])] = true;
    }
    return on;
  }

  [[nodiscard]] int across(int joint, int body) const {
    const TreeJoint& own = tree_.joints[body_index(joint)];
    return own.parent == body ? own.child : own.parent;
  }

  void turn_gravity(int root, int base) {
    robot_.base_acceleration = tree_.base_acceleration;
    if (root == base) return;
    const std::vector<bool> between = path(root, base);
    Matrix3 turn = Matrix3::identity();
    int body = base;
    while (body != root) {
      for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
        const TreeJoint& joint = tree_.joints[j];
        if (!between[j] || joint.child != body) continue;
        if (joint.type != TreeJointType::kFixed) {
          robot_.warnings.push_back(
              {Severity::kWarning, joint.place.position, joint.place.length,
               fmt::format("joint '{}' moves between the root '{}' and the base '{}'",
                           printable(joint.name), printable(tree_.bodies[body_index(root)].name),
                           printable(tree_.bodies[body_index(base)].name)),
               "gravity is taken as if the base stood as the root does"});
          return;
        }
        turn = joint.pose.R * turn;
        body = joint.parent;
        break;
      }
    }
    robot_.base_acceleration = transposed(turn) * tree_.base_acceleration;
  }

  /// The body and all that hangs on it, but by the joint that it was reached by.
  void add_body(int group, int body, const Pose& pose, int from) {
    robot_.groups[body_index(group)].bodies.push_back({body, pose});
    for (const int j : at_body_[body_index(body)]) {
      if (j == from) continue;
      const TreeJoint& joint = tree_.joints[body_index(j)];
      const bool down = joint.parent == body;
      if (!down && !chain_) continue;
      if (joint.type != TreeJointType::kFixed && chain_ && !on_chain_[body_index(j)]) {
        leave_out(j, body, group);
        continue;
      }
      if (joint.type == TreeJointType::kFixed) {
        add_body(group, down ? joint.child : joint.parent,
                 pose * (down ? joint.pose : inverse(joint.pose)), j);
        continue;
      }
      if (joint.refusal) {
        diagnostics_.error(joint.refusal->position, joint.refusal->length, joint.refusal->message,
                           joint.refusal->hint);
      }
      MovingGroup moved;
      moved.joint = j;
      moved.reversed = !down;
      moved.parent = group;
      moved.pose = down ? pose * joint.pose : pose;
      moved.axis = down ? joint.axis : -joint.axis;
      moved.point = joint.point;
      const int next = static_cast<int>(robot_.groups.size());
      robot_.groups.push_back(std::move(moved));
      add_body(next, down ? joint.child : joint.parent, down ? Pose{} : inverse(joint.pose), j);
    }
  }

  /// Mass beyond a joint, seen from a body.
  void collect(int body, int from, Real& mass, std::vector<std::string>& names) const {
    mass += tree_.bodies[body_index(body)].mass;
    names.push_back(tree_.bodies[body_index(body)].name);
    for (const int j : at_body_[body_index(body)]) {
      if (j != from) collect(across(j, body), j, mass, names);
    }
  }

  void leave_out(int j, int body, int group) {
    const TreeJoint& joint = tree_.joints[body_index(j)];
    Real mass = 0;
    std::vector<std::string> names;
    collect(across(j, body), j, mass, names);
    robot_.warnings.push_back(
        {Severity::kWarning, joint.place.position, joint.place.length,
         fmt::format("joint '{}' moves beside the chain: {} ({:.4g} kg) {} left out",
                     printable(joint.name), few_names(names), static_cast<double>(mass),
                     names.size() == 1 ? "is" : "are"),
         group == 0
             ? "it hangs on the base and moves no joint of the chain"
             : "its weight is missing in the torque; without --tip it is part of the robot"});
  }

  void warn_of_what_stands_above(int base) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      const bool has =
          std::any_of(robot_.groups.begin(), robot_.groups.end(), [&](const MovingGroup& group) {
            return std::any_of(
                group.bodies.begin(), group.bodies.end(),
                [&](const GroupedBody& own) { return own.body == static_cast<int>(i); });
          });
      if (!has) names.push_back(tree_.bodies[i].name);
    }
    const Body& body = tree_.bodies[body_index(base)];
    robot_.warnings.push_back({Severity::kWarning, body.place.position, body.place.length,
                               fmt::format("what does not hang on the base '{}' is left out: {}",
                                           printable(body.name), few_names(names)),
                               "expected with --base: the base stands still"});
  }

  void set_tip(int tip) {
    for (std::size_t g = 0; g < robot_.groups.size(); ++g) {
      for (const GroupedBody& own : robot_.groups[g].bodies) {
        if (own.body != tip) continue;
        robot_.tip_group = static_cast<int>(g);
        robot_.tip = own.pose;
      }
    }
  }

  void weigh(MovingGroup& group) const {
    for (const GroupedBody& own : group.bodies) {
      const Body& body = tree_.bodies[body_index(own.body)];
      const Vector3 centre = own.pose * body.centre;
      group.mass += body.mass;
      group.first_moment = group.first_moment + body.mass * centre;
      group.inertia =
          group.inertia + turned(own.pose.R, body.inertia) + parallel_axes(body.mass, centre);
    }
  }

  const BodyTree& tree_;
  const TreePart& part_;
  Diagnostics& diagnostics_;
  std::vector<std::vector<int>> at_body_;  // joints of each body, in the order of the text
  bool chain_ = false;
  std::vector<bool> on_chain_;  // joints
  GroupedRobot robot_;
};

}  // namespace

GroupedRobot grouped(const BodyTree& tree, const TreePart& part, Diagnostics& diagnostics) {
  return Grouping(tree, part, diagnostics).run();
}

}  // namespace dyngen
