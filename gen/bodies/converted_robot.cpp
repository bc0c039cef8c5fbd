// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/bodies/converted_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include "gen/bodies/decimal.h"
#include "gen/robot_file/keywords.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

constexpr int kNameWidth = 10, kColumnWidth = 12;

std::size_t index_of_part(int index) { return static_cast<std::size_t>(index); }

/// "file.urdf" of "some/folder/file.urdf"
std::string without_folder(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

class TextWriter {
 public:
  TextWriter(const ConvertedRobot& robot, const std::string& file_name)
      : robot_(robot), file_name_(file_name) {}

  /// Whether a number was beyond all bounds, so that the text is none.
  [[nodiscard]] bool is_beyond_bounds() const { return beyond_; }

  std::string write() {
    add_comment();
    const std::string name = robot_.tree.name.empty()
                                 ? std::filesystem::path(file_name_).stem().string()
                                 : robot_.tree.name;
    line("name", identifier_of(name, "r"));
    line("number_link", std::to_string(robot_.rows.size()));
    add_table();
    add_bodies();
    add_actuators();
    add_limits();
    std::string names;
    for (const std::string& own : robot_.names) names += (names.empty() ? "" : " ") + own;
    line("joints", names);
    constexpr std::array<RowKey, 3> kGravity = {RowKey::kGx, RowKey::kGy, RowKey::kGz};
    for (std::size_t k = 0; k < 3; ++k) {
      const Real value = robot_.robot.base_acceleration[k];
      constexpr Real kNoGravity = 1e-15L;  // m/s^2, of a turn by right angles that was rounded
      if (std::fabs(value) > kNoGravity) line(row_keyword(kGravity[k]), number(value));
    }
    add_springs();
    text_ += "stop\n";
    return std::move(text_);
  }

 private:
  using Value = std::function<std::string(const DhRow&)>;

  /// A number that a robot may have; NaN is none.
  std::string number(Real value) {
    constexpr Real kLargest = 1e60L;
    if (std::fabs(value) <= kLargest) return decimal(value);
    beyond_ = true;
    return "0";
  }

  void line(std::string_view keyword, const std::string& rest) {
    text_ += fmt::format("{:<{}} {}\n", keyword, kNameWidth, rest);
  }
  void row(RowKey key, const Value& value) {
    std::string text = fmt::format("{:<{}}", row_keyword(key), kNameWidth);
    for (const DhRow& own : robot_.rows) text += fmt::format(" {:>{}}", value(own), kColumnWidth);
    text_ += text + "\n";
  }
  /// Left out where all are zero, which an absent row is.
  void row_unless_zero(RowKey key, const Value& value) {
    const bool zero = std::all_of(robot_.rows.begin(), robot_.rows.end(),
                                  [&](const DhRow& own) { return value(own) == "0"; });
    if (!zero) row(key, value);
  }

  [[nodiscard]] std::string bodies_of(int group) const {
    std::string names;
    for (const GroupedBody& own : robot_.robot.groups[index_of_part(group)].bodies) {
      names += (names.empty() ? "" : " + ") +
               printable(robot_.tree.bodies[index_of_part(own.body)].name);
    }
    return names;
  }

  void add_comment() {
    text_ += fmt::format("# Made by dyngen of {} ({}). Frame 0 is that of {}.\n",
                         printable(without_folder(file_name_)), robot_.tree.format, bodies_of(0));
    for (std::size_t j = 0; j < robot_.rows.size(); ++j) {
      const DhRow& own = robot_.rows[j];
      const MovingGroup& group = robot_.robot.groups[index_of_part(own.group)];
      const std::string joint = printable(robot_.tree.joints[index_of_part(group.joint)].name);
      std::string what;
      switch (own.use) {
        case DhRowUse::kJoint:
          what = fmt::format("joint {}{} moves {}", joint,
                             group.reversed ? " (from its child)" : "", bodies_of(own.group));
          break;
        case DhRowUse::kMount:
          what = fmt::format("a fixed step, towards joint {}", joint);
          break;
        case DhRowUse::kTip:
          what = "the frame of the tip";
          break;
      }
      text_ += fmt::format("#   {:>2}  {}\n", j + 1, what);
    }
  }

  void add_table() {
    add_joint_types();
    const bool chain = [&] {
      for (std::size_t j = 0; j < robot_.rows.size(); ++j) {
        if (robot_.rows[j].parent != static_cast<int>(j)) return false;
      }
      return true;
    }();
    if (!chain) row(RowKey::kAnt, [](const DhRow& own) { return std::to_string(own.parent); });
    row(RowKey::kAl, [](const DhRow& own) { return angle_text(own.alpha); });
    row(RowKey::kD, [this](const DhRow& own) { return number(own.d); });
    row(RowKey::kTh, [](const DhRow& own) { return angle_text(own.theta); });
    row(RowKey::kR, [this](const DhRow& own) { return number(own.r); });
  }

  void add_joint_types() {
    row(RowKey::kSigma, [&](const DhRow& own) -> std::string {
      const TreeJoint* joint = joint_of(own);
      if (joint == nullptr) return "2";
      return joint->type == TreeJointType::kRevolute ? "0" : "1";
    });
  }

  /// Null for fixed rows.
  [[nodiscard]] const TreeJoint* joint_of(const DhRow& own) const {
    if (own.use != DhRowUse::kJoint) return nullptr;
    const int joint = robot_.robot.groups[index_of_part(own.group)].joint;
    return &robot_.tree.joints[index_of_part(joint)];
  }

  void add_bodies() {
    std::vector<FrameInertia> all;
    for (const DhRow& own : robot_.rows) {
      all.push_back(own.use == DhRowUse::kJoint
                        ? inertia_in(robot_.robot.groups[index_of_part(own.group)], own.frame)
                        : FrameInertia{});
    }
    const auto of = [&](const DhRow& own) -> const FrameInertia& {
      return all[static_cast<std::size_t>(&own - robot_.rows.data())];
    };
    // what rounding has left of zero
    constexpr Real kRoundingOfNumbers = 1e-15L;
    const auto clean = [this](Real value, Real size) {
      return number(std::fabs(value) <= kRoundingOfNumbers * size ? 0 : value);
    };
    const auto moment_size = [&](const DhRow& own) {
      const RealMatrix& J = of(own).inertia;
      return std::max({std::fabs(J[0][0]), std::fabs(J[1][1]), std::fabs(J[2][2])});
    };
    const auto first_size = [&](const DhRow& own) {
      const FrameInertia& f = of(own);
      return std::max(norm(f.first_moment), 1e3L * kSameLength * std::fabs(f.mass));
    };
    row(RowKey::kM, [&](const DhRow& own) { return number(of(own).mass); });
    constexpr std::array<RowKey, 3> kFirst = {RowKey::kMX, RowKey::kMY, RowKey::kMZ};
    for (std::size_t k = 0; k < 3; ++k) {
      row(kFirst[k],
          [&](const DhRow& own) { return clean(of(own).first_moment[k], first_size(own)); });
    }
    struct Moment {
      RowKey key;
      std::size_t i, k;
    };
    constexpr std::array<Moment, 6> kMomentRows = {{{RowKey::kXX, 0, 0},
                                                    {RowKey::kXY, 0, 1},
                                                    {RowKey::kXZ, 0, 2},
                                                    {RowKey::kYY, 1, 1},
                                                    {RowKey::kYZ, 1, 2},
                                                    {RowKey::kZZ, 2, 2}}};
    for (const Moment& own : kMomentRows) {
      row(own.key,
          [&](const DhRow& dh) { return clean(of(dh).inertia[own.i][own.k], moment_size(dh)); });
    }
  }

  void add_actuators() {
    const auto value = [&](std::optional<Real> TreeJoint::*member) {
      return [this, member](const DhRow& own) -> std::string {
        const TreeJoint* joint = joint_of(own);
        return joint == nullptr ? "0" : number((joint->*member).value_or(0));
      };
    };
    row_unless_zero(RowKey::kIA, value(&TreeJoint::armature));
    row_unless_zero(RowKey::kFs, value(&TreeJoint::friction));
    row_unless_zero(RowKey::kFv, value(&TreeJoint::damping));
  }

  /// A spring's torque -k (q - q0) has to be made up for: the effect is k q - k q0.
  void add_springs() {
    for (std::size_t j = 0; j < robot_.rows.size(); ++j) {
      const TreeJoint* joint = joint_of(robot_.rows[j]);
      if (joint == nullptr || joint->stiffness == 0) continue;
      text_ +=
          fmt::format("effect linear_spring joint={} k={} c={}\n", j + 1, number(joint->stiffness),
                      number(-joint->stiffness * joint->spring_reference));
    }
  }

  void add_limits() {
    const auto add = [&](RowKey key, std::optional<Real> TreeJoint::*member) {
      const Value value = [this, member](const DhRow& own) -> std::string {
        const TreeJoint* joint = joint_of(own);
        if (joint == nullptr || !(joint->*member)) return "-";
        return number(*(joint->*member));
      };
      const bool none = std::all_of(robot_.rows.begin(), robot_.rows.end(),
                                    [&](const DhRow& own) { return value(own) == "-"; });
      if (!none) row(key, value);
    };
    add(RowKey::kQmin, &TreeJoint::lower);
    add(RowKey::kQmax, &TreeJoint::upper);
    add(RowKey::kVmax, &TreeJoint::velocity);
    add(RowKey::kTaumax, &TreeJoint::effort);
  }

  const ConvertedRobot& robot_;
  const std::string& file_name_;
  std::string text_;
  bool beyond_ = false;
};

/// Names of rows: joints' names, each once.
std::vector<std::string> row_names(const ConvertedRobot& robot, const std::string& tip) {
  std::set<std::string> taken;
  const auto unique = [&](const std::string& wanted) {
    std::string name = wanted;
    for (int count = 2; !taken.insert(name).second; ++count) {
      name = fmt::format("{}_{}", wanted, count);
    }
    return name;
  };
  std::vector<std::string> names(robot.rows.size());
  for (const bool joints : {true, false}) {  // those of joints first: they keep their names
    for (std::size_t j = 0; j < robot.rows.size(); ++j) {
      const DhRow& row = robot.rows[j];
      if ((row.use == DhRowUse::kJoint) != joints) continue;
      const MovingGroup& group = robot.robot.groups[index_of_part(row.group)];
      const std::string joint = robot.tree.joints[index_of_part(group.joint)].name;
      std::string name = joint;
      if (row.use == DhRowUse::kMount) name += "_mount";
      if (row.use == DhRowUse::kTip) name = tip + "_frame";
      names[j] = unique(identifier_of(name, "j"));
    }
  }
  return names;
}

}  // namespace

std::string identifier_of(const std::string& name, const std::string& first) {
  std::string result = name;
  for (char& c : result) {
    if (!is_identifier(std::string("_") + c)) c = '_';
  }
  if (!is_identifier(result)) result = first + result;
  if (find_keyword(result) != nullptr) result += "_";
  return result;
}

ConvertedRobot converted_robot(BodyTree tree, const TreePart& part, const std::string& file_name,
                               Diagnostics& diagnostics) {
  ConvertedRobot result;
  result.tree = std::move(tree);
  result.robot = grouped(result.tree, part, diagnostics);
  result.rows = dh_rows(result.robot);
  if (result.rows.size() > static_cast<std::size_t>(kMaxJoints)) {
    diagnostics.error(
        result.tree.place.position, result.tree.place.length,
        fmt::format("the robot has {} joints, {} rows of a DH table",
                    result.robot.groups.size() - 1, result.rows.size()),
        fmt::format("at most {} are read: choose a part by --base LINK --tip LINK", kMaxJoints));
    throw ModelError(diagnostics.render());
  }
  result.names = row_names(result, part.tip);
  TextWriter writer(result, file_name);
  result.text = writer.write();
  if (writer.is_beyond_bounds()) {
    diagnostics.error(result.tree.place.position, result.tree.place.length,
                      "lengths and masses are so large that their products have no digits left",
                      "expected metres and kilograms");
    throw ModelError(diagnostics.render());
  }
  return result;
}

TextPlace origin_of(const ConvertedRobot& robot, RowKey key, std::size_t column) {
  if (key == RowKey::kGx || key == RowKey::kGy || key == RowKey::kGz) {
    return robot.tree.gravity_place;
  }
  if (column >= robot.rows.size()) return robot.tree.place;
  const DhRow& row = robot.rows[column];
  const MovingGroup& group = robot.robot.groups[index_of_part(row.group)];
  const TreeJoint& joint = robot.tree.joints[index_of_part(group.joint)];
  switch (key) {
    case RowKey::kSigma:
    case RowKey::kAnt:
      return joint.place;
    case RowKey::kAl:
    case RowKey::kD:
    case RowKey::kTh:
    case RowKey::kR:
      return joint.pose_place;
    case RowKey::kQmin:
    case RowKey::kQmax:
    case RowKey::kVmax:
    case RowKey::kAmax:
    case RowKey::kTaumax:
      return joint.limit_place;
    case RowKey::kIA:
    case RowKey::kFs:
    case RowKey::kFv:
    case RowKey::kOff:
      return joint.dynamics_place;
    default:
      return robot.tree.bodies[index_of_part(group.bodies.front().body)].inertial_place;
  }
}

}  // namespace dyngen
