// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_output/robot_tree.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen {

namespace {

class RobotTreeMaker {
 public:
  RobotTreeMaker(const RobotFile& file, const RobotModel& model, const std::string& target)
      : file_(file),
        model_(model),
        target_(target),
        diagnostics_(file.file_name, file.source_text) {}

  BodyTree make() {
    refuse_sums_and_unknowns();
    throw_if_wrong();
    tree_.format = target_;
    tree_.name = model_.name;
    Body base;
    base.name = "base";
    tree_.bodies.push_back(std::move(base));
    frames_.emplace_back();
    for (int j = 1; j <= model_.size(); ++j) add_row(j);
    for (std::size_t k = 0; k < 3; ++k) {
      tree_.base_acceleration[k] = number(model_.gravity[k].value);
    }
    warn_of_rows();
    add_effects();
    throw_if_wrong();
    tree_.warnings = diagnostics_.all();
    return std::move(tree_);
  }

 private:
  void throw_if_wrong() const {
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
  }

  static Real number(const GiNaC::ex& value) { return to_double(value); }

  [[nodiscard]] const FieldValue* field(RowKey key, int j) const {
    const Row& row = file_.row(key);
    return row.present ? &row.values[static_cast<std::size_t>(j - 1)] : nullptr;
  }
  [[nodiscard]] Real value(RowKey key, int j) const {
    const FieldValue* own = field(key, j);
    return own == nullptr || own->unknown ? 0 : number(own->value);
  }
  [[nodiscard]] std::optional<Real> limit(RowKey key, int j) const {
    const FieldValue* own = field(key, j);
    if (own == nullptr || own->unknown) return std::nullopt;
    return number(own->value);
  }

  void refuse_sums_and_unknowns() {
    if (file_.parameters == ParameterMeaning::kBase) {
      diagnostics_.error(file_.last_word, 1,
                         fmt::format("the file holds base parameters, which are sums over bodies: "
                                     "{} describes bodies",
                                     target_),
                         "fit with --consistent, which finds bodies");
    }
    for (std::size_t k = 0; k < kRowKeyCount; ++k) {
      const auto key = static_cast<RowKey>(k);
      const bool limits = key == RowKey::kQmin || key == RowKey::kQmax || key == RowKey::kVmax ||
                          key == RowKey::kAmax || key == RowKey::kTaumax;
      if (limits) continue;
      for (const FieldValue& own : file_.row(key).values) {
        if (!own.unknown) continue;
        diagnostics_.error(
            own.position, own.length,
            fmt::format("'{}' is unknown ('*'): {} holds numbers", row_keyword(key), target_),
            "write a number");
      }
    }
  }

  /// The pose of a row's frame at q = 0 in the frame in front of it, and of the distal frame
  /// behind.
  void add_row(int j) {
    const JointModel& own = model_.joint(j);
    const Real al = number(own.alpha), d = number(own.d.value), th = number(own.theta),
               r = number(own.r.value);
    const Pose about_x{turn_x(al), {{d, 0, 0}}}, about_z{turn_z(th), {{0, 0, r}}};
    const bool modified = model_.convention == DhConvention::kModified;
    TreeJoint joint;
    joint.name = own.name;
    joint.parent = own.parent;
    joint.child = j;
    const Pose& before = frames_[static_cast<std::size_t>(own.parent)];
    joint.pose = modified ? before * about_x * about_z : before * about_z;
    frames_.push_back(modified ? Pose{} : about_x);  // Tx(d) Rx(al), which commute
    joint.axis = {{0, 0, 1}};
    joint.type = own.type == JointType::kRevolute    ? TreeJointType::kRevolute
                 : own.type == JointType::kPrismatic ? TreeJointType::kPrismatic
                                                     : TreeJointType::kFixed;
    joint.lower = limit(RowKey::kQmin, j);
    joint.upper = limit(RowKey::kQmax, j);
    joint.velocity = limit(RowKey::kVmax, j);
    joint.effort = limit(RowKey::kTaumax, j);
    joint.damping = value(RowKey::kFv, j);
    joint.friction = value(RowKey::kFs, j);
    joint.armature = value(RowKey::kIA, j);
    joint.place = place_of(RowKey::kSigma, j);
    joint.pose_place = place_of(RowKey::kAl, j);
    joint.limit_place = place_of(RowKey::kQmin, j);
    joint.dynamics_place = place_of(RowKey::kIA, j);
    tree_.joints.push_back(std::move(joint));
    add_body(j);
  }

  [[nodiscard]] TextPlace place_of(RowKey key, int j) const {
    const FieldValue* own = field(key, j);
    if (own == nullptr) return {file_.last_word, 1};
    return {own->position, own->length};
  }

  void add_body(int j) {
    const JointModel& own = model_.joint(j);
    const auto chi = [&](Chi kind) { return number(own.chi[index(kind)].value); };
    Body body;
    body.name = own.name + "_link";
    body.place = place_of(RowKey::kSigma, j);
    body.inertial_place = place_of(RowKey::kM, j);
    body.mass = chi(Chi::kM);
    const Vector3 first{{chi(Chi::kMX), chi(Chi::kMY), chi(Chi::kMZ)}};
    if (body.mass == 0 && norm(first) > 0) {
      diagnostics_.error(body.inertial_place.position, body.inertial_place.length,
                         fmt::format("link {} has first moments and no mass: it has no centre of "
                                     "mass that {} could hold",
                                     j, target_),
                         "write its mass");
      return;
    }
    const Matrix3 about_origin{{{{{chi(Chi::kXX), chi(Chi::kXY), chi(Chi::kXZ)}},
                                 {{chi(Chi::kXY), chi(Chi::kYY), chi(Chi::kYZ)}},
                                 {{chi(Chi::kXZ), chi(Chi::kYZ), chi(Chi::kZZ)}}}}};
    const Vector3 centre = body.mass == 0 ? Vector3{} : (1 / body.mass) * first;
    const Matrix3 central = about_origin + (-1 * parallel_axes(body.mass, centre));
    const Pose& frame = frames_.back();  // of the file's parameters, in the body's frame
    body.centre = frame * centre;
    if (body.mass == 0) body.centre = {};
    body.inertia = turned(frame.R, central);
    Real size = 0;
    for (std::size_t i = 0; i < 3; ++i) size += norm(body.inertia[i]);
    body.has_inertial = body.mass != 0 || size != 0;
    tree_.bodies.push_back(std::move(body));
  }

  void warn_of_rows() {
    for (const auto& [key, what] : {std::pair{RowKey::kOff, "a constant torque"},
                                    std::pair{RowKey::kAmax, "a limit of acceleration"}}) {
      for (int j = 1; j <= model_.size(); ++j) {
        const FieldValue* own = field(key, j);
        if (own == nullptr || own->unknown || own->value.is_zero()) continue;
        diagnostics_.warning(own->position, own->length,
                             fmt::format("'{}' of joint {} ({}) is left out", row_keyword(key), j,
                                         model_.joint(j).name),
                             fmt::format("{} has no field for {}", target_, what));
      }
    }
  }

  /// A linear spring of one joint is a field of MJCF; everything else is left out.
  void add_effects() {
    for (const EffectRow& effect : file_.effects) {
      if (target_ == "MJCF" && effect.name == "linear_spring" && add_spring(effect)) continue;
      diagnostics_.warning(effect.position, static_cast<int>(effect.name.size()),
                           fmt::format("effect '{}' is left out", printable(effect.name)),
                           fmt::format("{} has no field for it", target_));
    }
  }

  bool add_spring(const EffectRow& effect) {
    std::optional<Real> joint, k, c;
    for (const EffectRow::Setting& own : effect.settings) {
      if (own.value.unknown) return false;
      const Real setting = number(own.value.value);
      if (own.key == "joint") joint = setting;
      if (own.key == "k") k = setting;
      if (own.key == "c") c = setting;
    }
    if (!joint || !k || *k == 0 || *joint < 1 || *joint > model_.size()) return false;
    TreeJoint& own = tree_.joints[static_cast<std::size_t>(*joint) - 1];
    if (own.stiffness != 0 || own.type == TreeJointType::kFixed) return false;
    own.stiffness = *k;
    own.spring_reference = -c.value_or(0) / *k;
    return true;
  }

  const RobotFile& file_;
  const RobotModel& model_;
  const std::string& target_;
  Diagnostics diagnostics_;
  BodyTree tree_;
  std::vector<Pose> frames_;  // of the file's parameters in the bodies' frames
};

}  // namespace

BodyTree robot_tree(const RobotFile& file, const RobotModel& model, const std::string& target) {
  return RobotTreeMaker(file, model, target).make();
}

}  // namespace dyngen
