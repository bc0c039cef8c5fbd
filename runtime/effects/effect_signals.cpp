// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include "runtime/signals/differences.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kSignalBlock = 1024;  // samples whose regressor is in memory at once
/// rad or m: how far ahead and behind derivatives of the rigid model are known, and a parabola
/// between. The parabola is right to 0.1 % at 0.01 rad and to 1 % at 0.15 rad (three robots).
constexpr double kTangentStep = 0.05;
constexpr double kTravel = 2.5;  // encoder steps that a joint moves back before its sign turns

/// A variable that is a part of the model's torque, or its rate.
struct TorqueVariable {
  bool load_only = false;  ///< the inertial parameters alone
  bool of_partner = false;
  int differences = 0;
};

std::optional<TorqueVariable> torque_variable(std::string_view name) {
  static const std::map<std::string_view, TorqueVariable> variables = {
      {"tau_load", {true, false, 0}},      {"tau_load_other", {true, true, 0}},
      {"tau_load_rate", {true, false, 1}}, {"tau_load_acc", {true, false, 2}},
      {"torque", {false, false, 0}},       {"torque_rate", {false, false, 1}},
      {"torque_acc", {false, false, 2}}};
  const auto place = variables.find(name);
  if (place == variables.end()) return std::nullopt;
  return place->second;
}

std::optional<ParameterKind> parameter_variable(std::string_view name) {
  if (name == "Fc") return ParameterKind::kCoulomb;
  if (name == "Fv") return ParameterKind::kViscous;
  if (name == "Ia") return ParameterKind::kRotorInertia;
  return std::nullopt;
}

bool of_rigid_model(std::string_view name) {
  for (const std::string_view group : {"d_", "hidden_", "payload_", "contact_", "wrench_"}) {
    if (name.starts_with(group)) return true;
  }
  return false;
}

/// Whether there is one of it for all links.
bool of_whole_robot(std::string_view name) {
  return name.starts_with("d_g") || name.starts_with("hidden_g") || name.starts_with("payload_") ||
         name.starts_with("wrench_");
}

MatrixXd differentiated(const MatrixXd& columns, double sample_time, int times) {
  if (times == 1) return first_difference(columns, sample_time);
  if (times == 2) return second_difference(columns, sample_time);
  return columns;
}

/// The joint whose torque a torque variable is.
int joint_of(const TorqueVariable& variable, const EffectInstance& effect, int target) {
  if (variable.of_partner) return effect.other;
  if (!variable.load_only && effect.law.acts_on_all) return target;
  return effect.joint >= 0 ? effect.joint : target;
}

bool is_inertial(const LinearModel& model, int column) {
  return model.parameters[static_cast<std::size_t>(column)].kind == ParameterKind::kInertial;
}

}  // namespace

VectorXd travelled_sign(const VectorXd& q, const VectorXd& dq, double band) {
  VectorXd sign(q.size());
  if (!(band > 0)) {
    for (Index k = 0; k < q.size(); ++k) sign[k] = dq[k] > 0 ? 1 : dq[k] < 0 ? -1 : 0;
    return sign;
  }
  // before the first travel: the direction of that travel
  double now = 0, farthest = q.size() > 0 ? q[0] : 0;
  for (Index k = 0; k < q.size() && now == 0; ++k) {
    if (std::abs(q[k] - farthest) > band) now = q[k] > farthest ? 1 : -1;
  }
  for (Index k = 0; k < q.size(); ++k) {
    if (now * (q[k] - farthest) > 0) {
      farthest = q[k];
    } else if (std::abs(q[k] - farthest) > band) {
      now = -now;
      farthest = q[k];
      // certain now, true since the velocity reversal: friction near zero velocity acts in those
      // few samples
      for (Index i = k - 1; i >= 0 && now * dq[i] > 0; --i) sign[i] = now;
    }
    sign[k] = now;
  }
  return sign;
}

bool depends_on_model(const std::string& variable) {
  return torque_variable(variable) || parameter_variable(variable);
}

void EffectSignals::set_beta(const VectorXd& beta) {
  if (beta_.size() == beta.size() && beta_ == beta) return;
  beta_ = beta;
  rigid_.clear();
}

void EffectSignals::set_tangent_beta(const VectorXd& beta) {
  tangent_beta_ = beta;
  further_.clear();
  // those of payloads and contacts are the motion's alone
  std::erase_if(tangents_, [](const auto& entry) {
    const std::string& name = entry.first.second.first;
    return !name.starts_with("payload_") && !name.starts_with("contact_");
  });
}

const EffectSignals::RigidTorque& EffectSignals::rigid(std::size_t run) {
  const auto [place, added] = rigid_.try_emplace(run);
  RigidTorque& rigid = place->second;
  if (!added) return rigid;
  const LinearModel& model = data_.model;
  const Motion& motion = data_.runs[run].motion;
  const Index n = model.joints(), size = model.size();
  rigid.torque = rigid.load = MatrixXd::Zero(motion.samples(), n);
  MatrixXd Y;
  for (Index start = 0; start < motion.samples(); start += kSignalBlock) {
    const Index rows = std::min(kSignalBlock, motion.samples() - start);
    model.regressor(motion.q.middleRows(start, rows), motion.dq.middleRows(start, rows),
                    motion.ddq.middleRows(start, rows), Y);
    for (Index j = 0; j < n; ++j) {
      for (const int c : model.columns[static_cast<std::size_t>(j)]) {
        const auto part = Y.col(j * size + c) * beta_[c];
        rigid.torque.col(j).segment(start, rows) += part;
        if (is_inertial(model, c)) rigid.load.col(j).segment(start, rows) += part;
      }
    }
  }
  if (model.held) {
    rigid.torque += model.held->torque(motion.q, motion.dq, motion.ddq, false);
    rigid.load += model.held->torque(motion.q, motion.dq, motion.ddq, true);
  }
  const VectorXd& rotors = data_.robot.joined_rotors;
  for (Index j = 0; j < rotors.size(); ++j) rigid.load.col(j) -= rotors[j] * motion.ddq.col(j);
  return rigid;
}

const MatrixXd& EffectSignals::torque(std::size_t run) { return rigid(run).torque; }

const MatrixXd& EffectSignals::regressor_rows(std::size_t run, int joint) {
  if (run != rows_run_) regressor_rows_.clear();
  rows_run_ = run;
  const auto [place, added] = regressor_rows_.try_emplace(joint);
  MatrixXd& rows = place->second;
  if (!added) return rows;
  const LinearModel& model = data_.model;
  const Motion& motion = data_.runs[run].motion;
  const std::vector<int>& columns = model.columns[static_cast<std::size_t>(joint)];
  rows.resize(motion.samples(), static_cast<Index>(columns.size()));
  MatrixXd Y;
  for (Index start = 0; start < motion.samples(); start += kSignalBlock) {
    const Index count = std::min(kSignalBlock, motion.samples() - start);
    model.regressor(motion.q.middleRows(start, count), motion.dq.middleRows(start, count),
                    motion.ddq.middleRows(start, count), Y);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      rows.col(static_cast<Index>(i)).segment(start, count) =
          Y.col(Index{joint} * model.size() + columns[i]);
    }
  }
  return rows;
}

const MatrixXd& EffectSignals::held_torque(std::size_t run) {
  const auto [place, added] = held_torque_.try_emplace(run);
  if (added) {
    const Motion& motion = data_.runs[run].motion;
    place->second = data_.model.held->torque(motion.q, motion.dq, motion.ddq, false);
  }
  return place->second;
}

const MatrixXd& EffectSignals::filtered_rates(std::size_t run, int joint) {
  const auto [place, added] = filtered_rates_.try_emplace({run, joint});
  if (added) {
    const EffectRun& here = data_.runs[run];
    place->second = decimate(here.decimator,
                             first_difference(regressor_rows(run, joint), here.motion.sample_time));
  }
  return place->second;
}

TangentColumns EffectSignals::tangents(std::size_t run, const TangentKey& wanted,
                                       double further) const {
  if (!data_.robot.tangents) {
    throw MissingSignalError(
        fmt::format("effects: '{}' is a derivative of the rigid model, and this robot gives none",
                    wanted.first));
  }
  const Motion& motion = data_.runs[run].motion;
  return data_.robot.tangents(wanted, {motion.q, motion.dq, motion.ddq},
                              tangent_beta_.size() > 0 ? tangent_beta_ : beta_, further);
}

const MatrixXd& EffectSignals::tangent(std::size_t run, const std::string& name, int link) {
  const TangentKey wanted{name, link};
  const auto place = tangents_.find({run, wanted});
  if (place != tangents_.end()) return place->second;
  TangentColumns all = tangents(run, wanted, 0);
  for (auto& [key, columns] : all) tangents_.try_emplace({run, key}, std::move(columns));
  return tangents_.at({run, wanted});
}

const MatrixXd& EffectSignals::tangent_at(std::size_t run, const std::string& name, int link,
                                          double further) {
  const MatrixXd& here = tangent(run, name, link);
  if (further == 0) return here;
  if (!further_.contains({run, {name, link}})) {
    // one program gives all that an effect reads of a link
    const TangentColumns ahead = tangents(run, {name, link}, kTangentStep),
                         behind = tangents(run, {name, link}, -kTangentStep);
    for (const auto& [key, columns] : ahead) {
      if (key.second != link) continue;
      const MatrixXd &middle = tangent(run, key.first, link), &back = behind.at(key);
      further_[{run, key}] = {0, middle, (columns - back) / (2 * kTangentStep),
                              (columns - 2 * middle + back) / (2 * kTangentStep * kTangentStep)};
    }
  }
  Further& known = further_.at({run, {name, link}});
  if (known.distance != further) {
    known.columns = here + further * (known.slope + further * known.bend);
    known.distance = further;
  }
  return known.columns;
}

VectorXd EffectSignals::signal(std::size_t run, const std::string& name,
                               const EffectInstance& effect, int target) {
  const EffectRun& here = data_.runs[run];
  const Motion& motion = here.motion;
  const int joint = effect.joint >= 0 ? effect.joint : target;
  if (const auto torque = torque_variable(name)) {
    const RigidTorque& parts = rigid(run);
    const MatrixXd& all = torque->load_only ? parts.load : parts.torque;
    return differentiated(all.col(joint_of(*torque, effect, target)), motion.sample_time,
                          torque->differences);
  }
  if (const auto kind = parameter_variable(name)) {
    return VectorXd::Constant(motion.samples(), parameter_value(data_.model, beta_, joint, *kind));
  }
  if (of_rigid_model(name)) {
    const int column = name.starts_with("wrench_") ? joint : target;
    if (of_whole_robot(name)) return tangent(run, name, 0).col(column);
    const int place = effect.law.midpoint;
    const double further = place < 0 ? 0 : effect.parameters[place] / 2;
    return tangent_at(run, name, effect.link, further).col(column);
  }
  if (name == "q") return motion.q.col(joint);
  if (name == "qd") return motion.dq.col(joint);
  if (name == "qdd") return motion.ddq.col(joint);
  if (name == "sign_qd") {
    return travelled_sign(motion.q.col(joint), motion.dq.col(joint),
                          kTravel * here.position_step[joint]);
  }
  if (name == "q_other") return motion.q.col(effect.other);
  if (name == "qd_other") return motion.dq.col(effect.other);
  if (name == "qdd_other") return motion.ddq.col(effect.other);
  if (name == "t") return here.time;
  if (name == "temp") {
    if (motion.temperature.size() == 0) {
      throw MissingSignalError(fmt::format(
          "effect {} reads the temperature of joint {}, and the recording has none: expected a "
          "column temp, or temp1 .. temp{}",
          effect.law.name, joint + 1, data_.joints()));
    }
    return motion.temperature.col(joint);
  }
  throw std::invalid_argument(
      fmt::format("effect {}: there is no variable '{}'", effect.law.name, name));
}

MatrixXd EffectSignals::variables(std::size_t run, const EffectInstance& effect, int target) {
  constexpr Index kEach = 40;  // multiplications: a law's value, and the filter behind it
  const auto& names = effect.law.variables;
  data_.count_work(data_.runs[run].motion.samples(), static_cast<Index>(names.size()) + 1, kEach);
  MatrixXd values(data_.runs[run].motion.samples(), static_cast<Index>(names.size()));
  for (std::size_t v = 0; v < names.size(); ++v) {
    values.col(static_cast<Index>(v)) = signal(run, names[v], effect, target);
  }
  return values;
}

ModelDerivative EffectSignals::by_model(std::size_t run, const EffectInstance& effect, int target,
                                        const MatrixXd& by_variable) {
  const LinearModel& model = data_.model;
  const Motion& motion = data_.runs[run].motion;
  const int joint = effect.joint >= 0 ? effect.joint : target;
  std::map<int, VectorXd> sums;
  const auto add = [&](int column, const VectorXd& values) {
    const auto [place, added] = sums.try_emplace(column, values);
    if (!added) place->second += values;
  };
  for (std::size_t v = 0; v < effect.law.variables.size(); ++v) {
    const std::string& name = effect.law.variables[v];
    const auto slope = by_variable.col(static_cast<Index>(v));
    if (slope.isZero(0)) continue;
    if (const auto kind = parameter_variable(name)) {
      const int place = parameter_of(model, joint, *kind);
      if (place >= 0) add(place, slope);
    } else if (const auto torque = torque_variable(name)) {
      const int of = joint_of(*torque, effect, target);
      const MatrixXd& rows = regressor_rows(run, of);
      const std::vector<int>& columns = model.columns[static_cast<std::size_t>(of)];
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (torque->load_only && !is_inertial(model, columns[i])) continue;
        const MatrixXd signal = differentiated(rows.col(static_cast<Index>(i)), motion.sample_time,
                                               torque->differences);
        add(columns[i], slope.cwiseProduct(signal.col(0)));
      }
    }
  }
  ModelDerivative derivative;
  derivative.values.resize(motion.samples(), static_cast<Index>(sums.size()));
  for (const auto& [column, values] : sums) {
    derivative.values.col(static_cast<Index>(derivative.columns.size())) = values;
    derivative.columns.push_back(column);
  }
  return derivative;
}

}  // namespace dyngen::runtime
