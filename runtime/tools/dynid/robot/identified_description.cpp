// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/identified_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "gen/robot_edit/description_edit.h"
#include "runtime/consistency/realised_bodies.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/robot/description_bodies.h"
#include "runtime/tools/dynid/robot/joint_words.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What is written has the robot's torque to this, of the largest torque.
constexpr double kSameTorque = 1e-9;
/// A number that changes by less, relative to it, is not written: it is as it was. Of the ten of a
/// body, relative to the largest.
constexpr double kUnchanged = 1e-12;

bool changes(Real value, Real before) {
  return std::fabs(value - before) > kUnchanged * std::max(std::fabs(value), std::fabs(before));
}

Index place_of_chi(int link, Chi kind) {
  return static_cast<Index>(kChiCount) * (link - 1) + static_cast<Index>(index(kind));
}

/// What was left out and what it carries, lines.
std::vector<std::string> left_out_table(const std::vector<LeftOut>& left_out,
                                        const RobotModel& model,
                                        const std::vector<bool>& revolute) {
  std::vector<std::string> lines;
  if (left_out.empty()) return lines;
  lines.emplace_back("torque of the identified robot that is not in this file (rms):");
  for (const LeftOut& left : left_out) {
    std::string carried;
    for (Index j = 0; j < left.rms.size(); ++j) {
      if (left.rms[j] == 0) continue;
      carried += fmt::format("{}{:.3g} {} on {}", carried.empty() ? "" : ", ", left.rms[j],
                             revolute[static_cast<std::size_t>(j)] ? "N m" : "N",
                             coordinate_words(model, static_cast<int>(j)));
    }
    if (carried.empty()) carried = "not known: no recordings";
    lines.push_back(fmt::format("  {}: {}", left.what, carried));
    lines.push_back(fmt::format("    {}", left.reason));
  }
  return lines;
}

/// Writes one identified robot into one description.
class WriteBack {
 public:
  WriteBack(const std::string& identified, const std::string& file_name, const WriteBackTask& task,
            const EffectCatalogue& catalogue)
      : task_(task),
        robot_(
            describe_robot(parse_robot_file(identified, file_name), OpenParameters::kEverything)),
        standard_(numbers_of(build_model(robot_.file))),
        effects_(effect_instances(robot_.model, catalogue)),
        description_(description_model(task.description)),
        is_mjcf_(description_.bodies.form == RobotForm::kMjcf),
        beta_(in_base_parameters_of(description_, robot_, standard_)) {
    for (const JointModel& joint : robot_.model.joints) {
      if (joint.coordinate >= 0) links_.push_back(link_of(joint));
    }
    for (const JointModel& joint : description_.robot.model.joints) {
      if (joint.coordinate >= 0) own_links_.push_back(own_link_of(joint));
    }
  }

  IdentifiedDescription write() {
    IdentifiedDescription result;
    result.form = is_mjcf_ ? "MJCF" : "URDF";
    expected_ = beta_;
    edit_joints(result);
    edit_bodies(result);
    edit_.comment = task_.comment;
    const std::vector<std::string> why = edited(description_.bodies, edit_).drives_left_out;
    for (std::size_t i = 0; i < why.size(); ++i) {
      if (why[i].empty()) continue;
      for (const auto& [effect, what] : drive_effects_[i]) {
        leave_out(result, what, why[i]);
        effect_of_[result.left_out.size() - 1] = effect;
      }
    }
    measure(result.left_out);
    result.table = left_out_table(result.left_out, robot_.model, robot_.linear.revolute);
    if (!result.table.empty()) {
      edit_.comment.emplace_back();
      edit_.comment.insert(edit_.comment.end(), result.table.begin(), result.table.end());
    }
    for (const std::string& note : result.notes) edit_.comment.push_back(note);
    result.text = edited(description_.bodies, edit_).text;
    check(result.text);
    return result;
  }

 private:
  [[nodiscard]] int link_of(const JointModel& joint) const {
    return static_cast<int>(&joint - robot_.model.joints.data()) + 1;
  }
  [[nodiscard]] int own_link_of(const JointModel& joint) const {
    return static_cast<int>(&joint - description_.robot.model.joints.data()) + 1;
  }
  [[nodiscard]] double identified_number(int coordinate, Chi kind) const {
    return standard_[place_of_chi(links_[static_cast<std::size_t>(coordinate)], kind)];
  }
  /// The joint of the tree that moves a coordinate.
  [[nodiscard]] int tree_joint(int coordinate) const {
    const ConvertedRobot& converted = description_.bodies.robot;
    const int row = own_links_[static_cast<std::size_t>(coordinate)];
    const int group = converted.rows[static_cast<std::size_t>(row - 1)].group;
    return converted.robot.groups[static_cast<std::size_t>(group)].joint;
  }
  [[nodiscard]] std::string joint_name(int coordinate) const {
    return coordinate_words(robot_.model, coordinate);
  }
  [[nodiscard]] std::string form() const { return is_mjcf_ ? "MuJoCo" : "URDF"; }

  void leave_out(IdentifiedDescription& result, std::string what, std::string reason) {
    result.left_out.push_back({std::move(what), std::move(reason), {}});
  }

  // ---- joints

  JointEdit& edit_of(int coordinate) {
    const int joint = tree_joint(coordinate);
    for (JointEdit& own : edit_.joints) {
      if (own.joint == joint) return own;
    }
    edit_.joints.push_back({});
    edit_.joints.back().joint = joint;
    return edit_.joints.back();
  }

  /// A number that must not be negative, and the row of beta that is it alone.
  std::optional<Real> checked(IdentifiedDescription& result, int coordinate, Chi kind, double value,
                              const std::string& what) {
    if (value >= 0) return value;
    leave_out(result, fmt::format("{} of {}", what, joint_name(coordinate)),
              fmt::format("{:.4g} is negative: no {} is", value, what));
    constant_[result.left_out.size() - 1] = {coordinate, kind, value};
    subtract(coordinate, kind, value);
    return 0;
  }

  /// What is written lacks this much of a parameter.
  void subtract(int coordinate, Chi kind, double value) {
    const int link = own_links_[static_cast<std::size_t>(coordinate)];
    expected_ -= value * description_.robot.grouping.col(place_of_chi(link, kind));
  }

  void edit_joints(IdentifiedDescription& result) {
    std::vector<double> offset;
    for (int j = 0; j < robot_.linear.joints(); ++j) {
      const TreeJoint& joint =
          description_.bodies.robot.tree.joints[static_cast<std::size_t>(tree_joint(j))];
      const auto set = [&](std::optional<Real> JointEdit::*field, const std::optional<Real>& value,
                           const std::optional<Real>& before) {
        if (value && changes(*value, before.value_or(0))) edit_of(j).*field = value;
      };
      const double fv = identified_number(j, Chi::kFV), fs = identified_number(j, Chi::kFS);
      set(&JointEdit::damping, checked(result, j, Chi::kFV, fv, "viscous friction"), joint.damping);
      set(&JointEdit::friction, checked(result, j, Chi::kFS, fs, "Coulomb friction"),
          joint.friction);
      offset.push_back(identified_number(j, Chi::kOFF));
    }
    edit_effects(result, offset);
    for (int j = 0; j < robot_.linear.joints(); ++j) {
      const double off = offset[static_cast<std::size_t>(j)];
      if (off == 0) continue;
      leave_out(result, fmt::format("torque offset of {}", joint_name(j)),
                form() + " has no field for it");
      constant_[result.left_out.size() - 1] = {j, Chi::kOFF, off};
      subtract(j, Chi::kOFF, off);
    }
  }

  void edit_effects(IdentifiedDescription& result, std::vector<double>& offset) {
    for (const EffectInstance& effect : effects_) {
      if (effect.recording >= 0) continue;
      if (is_mjcf_ && became_field(effect, offset)) continue;
      leave_out(result,
                effect.law.name + (effect.joint < 0 ? "" : " of " + joint_name(effect.joint)),
                form() + " has no field for it");
      effect_of_[result.left_out.size() - 1] = &effect;
    }
  }

  /// Whether MuJoCo has fields for an effect; they are edited then.
  bool became_field(const EffectInstance& effect, std::vector<double>& offset) {
    const VectorXd& p = effect.parameters;
    const std::string& name = effect.law.name;
    if (!p.allFinite()) return false;
    if (name == "linear_spring" && p[0] > 0) {
      // k q + c and the joint's offset are k (q - reference)
      double& off = offset[static_cast<std::size_t>(effect.joint)];
      JointEdit& edit = edit_of(effect.joint);
      edit.stiffness = p[0];
      edit.spring_reference = -(p[1] + off) / p[0];
      subtract(effect.joint, Chi::kOFF, off);
      off = 0;
      return true;
    }
    if (name == "rotor_inertia" && p[0] >= 0) {
      extra_armature_[effect.joint] += p[0];
      return true;
    }
    const bool is_lag = name == "actuator_lag" && p[0] > 0;
    const bool is_gain = name == "joint_torque_gain" || name == "global_torque_gain";
    if (!is_lag && !is_gain) return false;
    for (const int j : joints_of(effect, robot_.linear.joints())) {
      DriveEdit& drive = drive_of(effect, j);
      if (is_lag) drive.time_constant = p[0];
      if (is_gain) drive.gain /= 1 + p[0];  // recorded over true, less 1
    }
    return true;
  }

  DriveEdit& drive_of(const EffectInstance& effect, int coordinate) {
    const int joint = tree_joint(coordinate);
    const std::string what = effect.law.name + " of " + joint_name(coordinate);
    for (std::size_t i = 0; i < edit_.drives.size(); ++i) {
      if (edit_.drives[i].joint != joint) continue;
      drive_effects_[i].emplace_back(&effect, what);
      return edit_.drives[i];
    }
    edit_.drives.push_back({});
    edit_.drives.back().joint = joint;
    drive_effects_.push_back({{&effect, what}});
    return edit_.drives.back();
  }

  // ---- bodies

  /// Rows of beta that bodies share in.
  [[nodiscard]] std::vector<Index> rows_of_bodies(const MatrixXd& K) const {
    std::vector<Index> rows;
    for (Index i = 0; i < K.rows(); ++i) {
      if (!K.row(i).isZero(0)) rows.push_back(i);
    }
    return rows;
  }

  /// Armature of each joint: of beta where it is a base parameter of its own, else the
  /// description's.
  void settle_armature(IdentifiedDescription& result, const MatrixXd& K) {
    const LinearModel& linear = description_.robot.linear;
    armature_ = VectorXd::Zero(linear.joints());
    for (int j = 0; j < linear.joints(); ++j) {
      const int own = parameter_of(linear, j, ParameterKind::kRotorInertia);
      const TreeJoint& joint =
          description_.bodies.robot.tree.joints[static_cast<std::size_t>(tree_joint(j))];
      const double before = static_cast<double>(joint.armature.value_or(0));
      const double extra = extra_armature_.contains(j) ? extra_armature_.at(j) : 0;
      if (own < 0 || !K.row(own).isZero(0)) {
        joined_armature_.push_back(j);
        armature_[j] = is_mjcf_ ? before : 0;
        if (extra != 0) edit_of(j).armature = before + extra;
        continue;
      }
      const double value = expected_[own];
      if (is_mjcf_ && value >= 0) {
        armature_[j] = value;
        if (changes(value + extra, before)) edit_of(j).armature = value + extra;
      } else if (value != 0) {
        leave_out(result, fmt::format("rotor inertia of {}", joint_name(j)),
                  is_mjcf_ ? fmt::format("{:.4g} is negative: no inertia is", value)
                           : "URDF has no field for it");
        constant_[result.left_out.size() - 1] = {j, Chi::kIA, value};
        expected_[own] = 0;
      }
    }
  }

  void edit_bodies(IdentifiedDescription& result) {
    const BodyGrouping all = body_grouping(description_, true);
    settle_armature(result, all.K);
    RealisedBodies found;
    std::string message;
    for (const bool with_massless : {false, true}) {
      const BodyGrouping grouping = with_massless ? all : body_grouping(description_, false);
      if (grouping.bodies.empty()) continue;
      for (const bool keep_armature : {true, false}) {
        VectorXd target = beta_without_actuators(keep_armature);
        const std::vector<Index> rows = rows_of_bodies(all.K);
        found = realise_bodies({static_cast<int>(grouping.bodies.size()),
                                grouping.K(rows, Eigen::all), target(rows), grouping.prior});
        if (!found.exact) continue;
        if (!keep_armature) drop_joined_armature(result);
        take_bodies(grouping, found, result);
        return;
      }
    }
    throw NoBodiesError(
        "no bodies that can exist have the base parameters of this fit: a mass or a moment would "
        "be "
        "negative. 'dynid fit --consistent' finds the nearest that do");
  }

  [[nodiscard]] VectorXd beta_without_actuators(bool keep_armature) const {
    VectorXd target = expected_;
    if (!keep_armature) return target;
    for (const int j : joined_armature_) {
      const int link = own_links_[static_cast<std::size_t>(j)];
      target -= armature_[j] * description_.robot.grouping.col(place_of_chi(link, Chi::kIA));
    }
    return target;
  }

  void drop_joined_armature(IdentifiedDescription& result) {
    for (const int j : joined_armature_) {
      if (armature_[j] == 0) continue;
      const double extra = extra_armature_.contains(j) ? extra_armature_.at(j) : 0;
      edit_of(j).armature = extra;
      result.notes.push_back(fmt::format(
          "the armature of {} is part of its link's inertia now: beside it no body can exist",
          joint_name(j)));
    }
  }

  void take_bodies(const BodyGrouping& grouping, const RealisedBodies& found,
                   IdentifiedDescription& result) {
    for (std::size_t i = 0; i < grouping.bodies.size(); ++i) {
      const Eigen::Matrix<double, 10, 1> ten = found.ten.segment<10>(10 * static_cast<Index>(i));
      const Eigen::Matrix<double, 10, 1> before =
          grouping.prior.segment<10>(10 * static_cast<Index>(i));
      const double change = (ten - before).cwiseAbs().maxCoeff();
      if (change <= kUnchanged * before.cwiseAbs().maxCoeff()) continue;
      BodyEdit edit;
      edit.body = grouping.bodies[i];
      edit.mass = ten[9];
      edit.centre = {{ten[6] / edit.mass, ten[7] / edit.mass, ten[8] / edit.mass}};
      RealMatrix about;
      about[0] = {{ten[0], ten[1], ten[2]}};
      about[1] = {{ten[1], ten[3], ten[4]}};
      about[2] = {{ten[2], ten[4], ten[5]}};
      edit.inertia = about + Real{-1} * parallel_axes(edit.mass, edit.centre);
      edit_.bodies.push_back(edit);
    }
    if (!found.message.empty()) {
      result.notes.emplace_back(
          "bodies without mass or volume in the description begin as balls of 0.1 m radius");
    }
  }

  // ---- what is left out

  /// rms over the recordings, of each joint.
  void measure(std::vector<LeftOut>& left_out) {
    if (left_out.empty() || task_.motions.empty()) return;
    if (!recordings_) {
      recordings_ =
          effect_recordings(robot_.linear, effect_robot(robot_), task_.motions, task_.rows, {});
    }
    EffectSignals signals(*recordings_);
    signals.set_beta(robot_.grouping * standard_);
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      if (constant_.contains(i)) left_out[i].rms = rms_of(constant_.at(i));
      if (effect_of_.contains(i)) left_out[i].rms = rms_of(*effect_of_.at(i), signals);
    }
  }

  struct Parameter {
    int coordinate;
    Chi kind;
    double value;
  };

  [[nodiscard]] VectorXd rms_of(const Parameter& parameter) const {
    VectorXd sum = VectorXd::Zero(robot_.linear.joints());
    double samples = 0;
    for (const EffectRun& run : recordings_->runs) {
      const Index j = parameter.coordinate;
      const auto N = static_cast<double>(run.motion.q.rows());
      double own = N;  // of OFF and Coulomb friction
      if (parameter.kind == Chi::kIA) own = run.motion.ddq.col(j).squaredNorm();
      if (parameter.kind == Chi::kFV) own = run.motion.dq.col(j).squaredNorm();
      sum[j] += parameter.value * parameter.value * own;
      samples += N;
    }
    return (sum / std::max(samples, 1.0)).cwiseSqrt();
  }

  [[nodiscard]] VectorXd rms_of(const EffectInstance& effect, EffectSignals& signals) const {
    VectorXd sum = VectorXd::Zero(robot_.linear.joints());
    double samples = 0;
    for (std::size_t run = 0; run < recordings_->runs.size(); ++run) {
      const EffectSignature torque = signature_of(*recordings_, signals, run, effect, {0});
      for (std::size_t i = 0; i < torque.joints.size(); ++i) {
        sum[torque.joints[i]] += torque.columns[i].squaredNorm();
      }
      if (!torque.columns.empty()) samples += static_cast<double>(torque.columns.front().rows());
    }
    return (sum / std::max(samples, 1.0)).cwiseSqrt();
  }

  // ---- what was written

  /// The frames of the robot file that is made of the text depend on its bodies: torques are
  /// compared, not parameters.
  void check(const std::string& text) const {
    const DescribedRobot read =
        describe_robot(parse_robot(text, task_.description), OpenParameters::kEverything);
    const VectorXd written =
        in_base_parameters_of(description_, read, numbers_of(build_model(read.file)));
    VectorXd expected = expected_;
    for (const auto& [joint, extra] : extra_armature_) {
      const int link = own_links_[static_cast<std::size_t>(joint)];
      expected += extra * description_.robot.grouping.col(place_of_chi(link, Chi::kIA));
    }
    const double difference = torque_difference(description_.robot.linear, written, expected);
    if (difference <= kSameTorque) return;
    throw std::logic_error(fmt::format(
        "the description that was to be written has another torque: {:.3g} of it", difference));
  }

  const WriteBackTask& task_;
  DescribedRobot robot_;
  StandardParameters standard_;
  std::vector<EffectInstance> effects_;
  DescriptionModel description_;
  bool is_mjcf_;
  VectorXd beta_;                       ///< of the description's model
  VectorXd expected_;                   ///< of what is written
  std::vector<int> links_, own_links_;  ///< of coordinates, from 1: in both robot files
  DescriptionEdit edit_;
  /// Of edit_.drives: what they are for.
  std::vector<std::vector<std::pair<const EffectInstance*, std::string>>> drive_effects_;
  std::map<int, double> extra_armature_;
  VectorXd armature_;
  std::vector<int> joined_armature_;  ///< coordinates whose rotor is no base parameter of its own
  std::map<std::size_t, Parameter> constant_;
  std::map<std::size_t, const EffectInstance*> effect_of_;
  std::optional<EffectRecordings> recordings_;
};

}  // namespace

IdentifiedDescription identified_description(const std::string& identified,
                                             const std::string& file_name,
                                             const WriteBackTask& task,
                                             const EffectCatalogue& catalogue) {
  return WriteBack(identified, file_name, task, catalogue).write();
}

}  // namespace dyngen::runtime
