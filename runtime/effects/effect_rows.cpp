// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "runtime/signals/differences.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestDelay = 0.05;  // s, where an effect gives no bound

/// What acts on one joint at full rate: a torque, and columns of J with their places.
struct JointEquations {
  VectorXd torque;  ///< (N)
  std::vector<int> places;
  std::vector<VectorXd> columns;  ///< (N) each; a place may come again: they add up

  void add(int place, VectorXd column) {
    places.push_back(place);
    columns.push_back(std::move(column));
  }
};

bool is_alignment(const EffectInstance& effect) {
  return effect.law.kind == EffectKind::kAlignment;
}

/// One evaluation of a law: on which joints its outputs act.
struct Application {
  int target = -1;
  std::vector<int> outputs;
};

std::vector<Application> applications(const EffectInstance& effect, int joints) {
  std::vector<Application> all;
  if (effect.law.acts_on_all || effect.joint < 0) {
    for (const int i : joints_of(effect, joints)) all.push_back({i, {i}});
  } else if (effect.law.outputs == 2) {
    all.push_back({effect.joint, {effect.joint, effect.other}});
  } else {
    all.push_back({effect.joint, {effect.joint}});
  }
  return all;
}

double chain_of(const EffectParameter& parameter, double value) {
  return by_logarithm(parameter) ? value : 1;
}

/// The rows of one run, joint by joint.
class RunRows {
 public:
  RunRows(const EffectRecordings& data, EffectSignals& signals, const EffectPoint& point,
          const EffectUnknowns& unknowns, std::size_t run)
      : data_(data),
        signals_(signals),
        point_(point),
        unknowns_(unknowns),
        run_(run),
        here_(data.runs[run]),
        x_(values_of(point, unknowns)),
        late_(alignment_of(point.effects, data.joints())) {
    joints_.resize(static_cast<std::size_t>(data.joints()));
    for (JointEquations& joint : joints_) joint.torque = VectorXd::Zero(here_.motion.samples());
  }

  RowBlock make() {
    add_effects();
    RowBlock block;
    block.Y = MatrixXd::Zero(here_.rows.Y.rows(), Index{data_.joints()} * unknowns_.size);
    block.tau = here_.rows.tau;
    block.counted = here_.rows.counted;
    for (int j = 0; j < data_.joints(); ++j) {
      fill(block.Y.middleCols(j * Index{unknowns_.size}, unknowns_.size), block.tau.col(j), j);
    }
    leave_out(block.counted);
    for (Index j = 0; j < block.tau.cols(); ++j) {
      for (Index k = 0; k < block.tau.rows(); ++k) {
        if (block.counted(k, j) != 0) continue;
        block.tau(k, j) = 0;
        block.Y.row(k).segment(j * unknowns_.size, unknowns_.size).setZero();
      }
    }
    return block;
  }

  /// As of equations_at().
  void add_to(PointEquations& equations, const std::vector<bool>& whole,
              const std::vector<bool>& beside) {
    add_effects();
    MatrixXd counted = here_.rows.counted;
    leave_out(counted);
    MatrixXd Y(here_.rows.Y.rows(), unknowns_.size);
    for (int j = 0; j < data_.joints(); ++j) {
      const auto place = static_cast<std::size_t>(j);
      if (!whole[place] && !beside[place]) continue;
      std::vector<int> columns = equations.columns[place];
      if (!whole[place]) std::erase_if(columns, [&](int c) { return c < unknowns_.base; });
      Y.setZero();
      VectorXd tau = here_.rows.tau.col(j);
      fill(Y, tau, j);
      JointRows rows;
      rows.A.resize(Y.rows(), static_cast<Index>(columns.size()) + 1);
      rows.A << Y(Eigen::all, columns), tau;
      for (Index k = 0; k < Y.rows(); ++k) {
        if (counted(k, j) == 0) rows.A.row(k).setZero();
      }
      rows.counted = counted.col(j).sum();
      equations.joints[place].push_back(std::move(rows));
    }
  }

 private:
  void add_effects() {
    for (std::size_t k = 0; k < point_.effects.size(); ++k) {
      const EffectInstance& effect = point_.effects[k];
      if (!is_alignment(effect) && data_.acts_in(effect, run_)) add_effect(k);
    }
    for (std::size_t k = 0; k < point_.effects.size(); ++k) {
      if (is_alignment(point_.effects[k])) add_lateness(k);
    }
  }

  void add_effect(std::size_t k) {
    const EffectInstance& effect = point_.effects[k];
    const EffectLaw& law = effect.law;
    const Index np = law.size(), nv = static_cast<Index>(law.variables.size());
    const Index ns = static_cast<Index>(law.states.size());
    EffectWanted wanted;
    wanted.by_parameter = true;
    wanted.by_variable = std::any_of(law.variables.begin(), law.variables.end(), depends_on_model);
    wanted.by_initial = unknowns_.initial[run_][k] >= 0;
    wanted.linear_only = true;
    for (std::size_t p = 0; p < law.parameters.size(); ++p) {
      const bool unknown = unknowns_.parameters[k][p] >= 0;
      if (unknown && law.parameters[p].role != EffectRole::kLinear) wanted.linear_only = false;
    }
    wanted.states_held = wanted.linear_only && !wanted.by_variable && !wanted.by_initial;
    for (const Application& application : applications(effect, data_.joints())) {
      const MatrixXd variables = signals_.variables(run_, effect, application.target);
      VectorXd state = point_.initial[run_][k] + first_states(law, variables);
      const EffectTorque torque =
          law.evaluate(variables, effect.parameters, here_.motion.sample_time, state, wanted);
      for (std::size_t o = 0; o < application.outputs.size(); ++o) {
        const Index out = static_cast<Index>(o);
        JointEquations& joint = joints_[static_cast<std::size_t>(application.outputs[o])];
        joint.torque += torque.torque.col(out);
        for (Index p = 0; p < np; ++p) {
          const int place = unknowns_.parameters[k][static_cast<std::size_t>(p)];
          if (place < 0) continue;
          const double chain =
              chain_of(law.parameters[static_cast<std::size_t>(p)], effect.parameters[p]);
          joint.add(place, chain * torque.by_parameter.col(out * np + p));
        }
        for (Index s = 0; wanted.by_initial && s < ns; ++s) {
          joint.add(unknowns_.initial[run_][k] + static_cast<int>(s),
                    torque.by_initial.col(out * ns + s));
        }
        if (!wanted.by_variable) continue;
        ModelDerivative slope = signals_.by_model(run_, effect, application.target,
                                                  torque.by_variable.middleCols(out * nv, nv));
        for (std::size_t i = 0; i < slope.columns.size(); ++i) {
          joint.add(slope.columns[i], slope.values.col(static_cast<Index>(i)));
        }
      }
    }
  }

  /// A later torque is the model's now, less its rate; a lag adds it.
  void add_lateness(std::size_t k) {
    const EffectInstance& effect = point_.effects[k];
    const std::size_t p = static_cast<std::size_t>(effect.law.alignment_parameter);
    const int place = unknowns_.parameters[k][p];
    if (place < 0) return;
    const bool delay = effect.law.alignment == AlignmentOperator::kDelay;
    const double chain = (delay ? -1 : 1) * chain_of(effect.law.parameters[p],
                                                     effect.parameters[static_cast<Index>(p)]);
    for (const int j : joints_of(effect, data_.joints())) {
      JointEquations& joint = joints_[static_cast<std::size_t>(j)];
      VectorXd torque = signals_.torque(run_).col(j) + joint.torque;
      if (delay) torque += late_.lag[j] * rate(torque);
      lateness_.push_back({j, place, chain * rate(torque)});
    }
  }

  [[nodiscard]] VectorXd rate(const VectorXd& column) const {
    return first_difference(column, here_.motion.sample_time);
  }

  /// Columns of J and torque of one joint. @param Y  (N x size) zeros  @param tau  as recorded
  void fill(Eigen::Ref<MatrixXd> Y, Eigen::Ref<VectorXd> tau, int j) {
    const double lag = late_.lag[j];
    const JointEquations& joint = joints_[static_cast<std::size_t>(j)];
    const Index nb = unknowns_.base;
    Y.leftCols(nb) = here_.rows.Y.middleCols(Index{j} * nb, nb);
    if (lag != 0) {
      const MatrixXd& rates = signals_.filtered_rates(run_, j);
      const std::vector<int>& columns = data_.model.columns[static_cast<std::size_t>(j)];
      for (std::size_t i = 0; i < columns.size(); ++i) {
        Y.col(columns[i]) += lag * rates.col(static_cast<Index>(i));
      }
    }
    if (late_.delay[j] != 0 && here_.motion.tau.size() > 0) {
      const double samples = late_.delay[j] / here_.motion.sample_time;
      // rows have more in their torque than what was recorded (leave_as_at): the change is added
      const VectorXd recorded = here_.motion.tau.col(j);
      tau += decimate(here_.decimator, shifted(recorded, samples) - recorded);
    }
    if (lag != 0 && data_.model.held) {
      tau -= lag * decimate(here_.decimator, rate(signals_.held_torque(run_).col(j)));
    }
    tau -= filtered(joint.torque, lag);
    const auto add = [&](int place, const VectorXd& column) {
      Y.col(place) += column;
      tau += x_[place] * column;
    };
    for (std::size_t i = 0; i < joint.places.size(); ++i) {
      add(joint.places[i], filtered(joint.columns[i], lag));
    }
    for (const Lateness& late : lateness_) {
      if (late.joint == j) add(late.place, filtered(late.column, 0));
    }
  }

  [[nodiscard]] VectorXd filtered(const VectorXd& column, double lag) const {
    if (column.isZero(0)) return VectorXd::Zero(here_.rows.Y.rows());
    return decimate(here_.decimator, lag == 0 ? column : (column + lag * rate(column)).eval());
  }

  /// Equations that an undone delay does not reach count not.
  void leave_out(MatrixXd& counted) const {
    const Index count = counted.rows();
    for (const EffectInstance& effect : point_.effects) {
      if (effect.law.alignment != AlignmentOperator::kDelay) continue;
      const double longest =
          std::max(kLongestDelay, effect.parameters[effect.law.alignment_parameter]);
      const double reach = longest / here_.motion.sample_time + double{kSincReach};
      const Index rows = std::min<Index>(
          count / 4,
          static_cast<Index>(std::ceil(reach / static_cast<double>(here_.decimator.factor))));
      for (const int j : joints_of(effect, data_.joints())) {
        counted.col(j).head(rows).setZero();
        counted.col(j).tail(rows).setZero();
      }
    }
  }

  struct Lateness {
    int joint, place;
    VectorXd column;
  };

  const EffectRecordings& data_;
  EffectSignals& signals_;
  const EffectPoint& point_;
  const EffectUnknowns& unknowns_;
  std::size_t run_;
  const EffectRun& here_;
  VectorXd x_;
  Alignment late_;
  std::vector<JointEquations> joints_;
  std::vector<Lateness> lateness_;
};

/// Which unknowns can act on each joint.
std::vector<std::vector<int>> visible(const EffectRecordings& data, const EffectPoint& point,
                                      const EffectUnknowns& unknowns) {
  std::vector<std::set<int>> columns;
  for (const auto& of_joint : data.model.columns) {
    columns.emplace_back(of_joint.begin(), of_joint.end());
  }
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    for (const int j : joints_of(effect, data.joints())) {
      std::set<int>& here = columns[static_cast<std::size_t>(j)];
      for (const int place : unknowns.parameters[k]) {
        if (place >= 0) here.insert(place);
      }
      for (const auto& run : unknowns.initial) {
        for (std::size_t s = 0; run[k] >= 0 && s < effect.law.states.size(); ++s) {
          here.insert(run[k] + static_cast<int>(s));
        }
      }
      // through tau_load and its like: what acts on the joint whose load it is
      for (const std::string& name : effect.law.variables) {
        if (!depends_on_model(name)) continue;
        for (const int of : {effect.joint, effect.other}) {
          if (of < 0) continue;
          const auto& load = data.model.columns[static_cast<std::size_t>(of)];
          here.insert(load.begin(), load.end());
        }
      }
    }
  }
  std::vector<std::vector<int>> result;
  for (const std::set<int>& of_joint : columns) {
    result.emplace_back(of_joint.begin(), of_joint.end());
  }
  return result;
}

}  // namespace

EffectPoint at_rest(const EffectRecordings& data, VectorXd beta,
                    std::vector<EffectInstance> effects) {
  EffectPoint point{std::move(beta), std::move(effects), {}};
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    point.initial.emplace_back();
    for (const EffectInstance& effect : point.effects) {
      point.initial.back().push_back(VectorXd::Zero(static_cast<Index>(effect.law.states.size())));
    }
  }
  return point;
}

EffectUnknowns base_unknowns(const EffectPoint& point) {
  EffectUnknowns unknowns;
  unknowns.base = unknowns.size = static_cast<int>(point.beta.size());
  for (const EffectInstance& effect : point.effects) {
    unknowns.parameters.emplace_back(static_cast<std::size_t>(effect.law.size()), -1);
  }
  for (std::size_t r = 0; r < point.initial.size(); ++r) {
    unknowns.initial.emplace_back(point.effects.size(), -1);
  }
  return unknowns;
}

bool by_logarithm(const EffectParameter& parameter) {
  return parameter.logarithmic && parameter.role != EffectRole::kLinear;
}

VectorXd values_of(const EffectPoint& point, const EffectUnknowns& unknowns) {
  VectorXd x(unknowns.size);
  x.head(unknowns.base) = point.beta;
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    for (std::size_t p = 0; p < unknowns.parameters[k].size(); ++p) {
      const int place = unknowns.parameters[k][p];
      if (place < 0) continue;
      const double value = effect.parameters[static_cast<Index>(p)];
      x[place] = by_logarithm(effect.law.parameters[p]) ? std::log(value) : value;
    }
    for (std::size_t r = 0; r < unknowns.initial.size(); ++r) {
      const int place = unknowns.initial[r][k];
      if (place >= 0) x.segment(place, point.initial[r][k].size()) = point.initial[r][k];
    }
  }
  return x;
}

EffectPoint with_values(EffectPoint point, const EffectUnknowns& unknowns, const VectorXd& x) {
  point.beta = x.head(unknowns.base);
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    EffectInstance& effect = point.effects[k];
    for (std::size_t p = 0; p < unknowns.parameters[k].size(); ++p) {
      const int place = unknowns.parameters[k][p];
      if (place < 0) continue;
      effect.parameters[static_cast<Index>(p)] =
          by_logarithm(effect.law.parameters[p]) ? std::exp(x[place]) : x[place];
    }
    for (std::size_t r = 0; r < unknowns.initial.size(); ++r) {
      const int place = unknowns.initial[r][k];
      if (place >= 0) point.initial[r][k] = x.segment(place, point.initial[r][k].size());
    }
  }
  return point;
}

Alignment alignment_of(const std::vector<EffectInstance>& effects, int joints) {
  Alignment late{VectorXd::Zero(joints), VectorXd::Zero(joints)};
  for (const EffectInstance& effect : effects) {
    if (!is_alignment(effect)) continue;
    const double seconds = effect.parameters[effect.law.alignment_parameter];
    for (const int j : joints_of(effect, joints)) {
      (effect.law.alignment == AlignmentOperator::kDelay ? late.delay : late.lag)[j] += seconds;
    }
  }
  return late;
}

std::string short_name(const EffectInstance& effect) {
  const int joint = effect.link > 0 ? effect.link : effect.joint + 1;
  if (effect.law.scope == EffectScope::kPair) {
    return fmt::format("{} {}<-{}", effect.law.name, joint, effect.other + 1);
  }
  return joint == 0 ? effect.law.name : fmt::format("{} {}", effect.law.name, joint);
}

std::vector<int> joints_of(const EffectInstance& effect, int joints) {
  if (effect.law.acts_on_all || effect.joint < 0) {
    const bool inward = effect.law.acts_inward && effect.joint >= 0;
    std::vector<int> all(static_cast<std::size_t>(inward ? effect.joint + 1 : joints));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  if (effect.law.outputs == 2) return {effect.joint, effect.other};
  return {effect.joint};
}

RowSource EffectEquations::source() const {
  return [this](const std::function<void(const RowBlock&)>& visit) {
    for (const RowBlock& block : blocks) visit(block);
  };
}

EffectEquations linearised(const EffectRecordings& data, EffectSignals& signals,
                           const EffectPoint& point, const EffectUnknowns& unknowns) {
  signals.set_beta(point.beta);
  EffectEquations equations;
  equations.size = unknowns.size;
  equations.columns = visible(data, point, unknowns);
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    equations.blocks.push_back(RunRows(data, signals, point, unknowns, run).make());
  }
  return equations;
}

PointEquations equations_at(const EffectRecordings& data, EffectSignals& signals,
                            const EffectPoint& point, const EffectUnknowns& unknowns,
                            const std::vector<bool>& whole, const std::vector<bool>& beside) {
  signals.set_beta(point.beta);
  PointEquations equations;
  equations.columns = visible(data, point, unknowns);
  equations.joints.resize(static_cast<std::size_t>(data.joints()));
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    RunRows(data, signals, point, unknowns, run).add_to(equations, whole, beside);
  }
  return equations;
}

EffectSignature signature_of(const EffectRecordings& data, EffectSignals& signals, std::size_t run,
                             const EffectInstance& effect, const std::vector<int>& wanted,
                             bool states_held) {
  const EffectRun& here = data.runs[run];
  const Index np = effect.law.size();
  EffectWanted parts;
  parts.states_held = states_held;
  parts.torque = false;
  parts.linear_only = true;
  for (const int column : wanted) {
    if (column == 0) {
      parts.torque = true;
      continue;
    }
    const EffectParameter& by = effect.law.parameters[static_cast<std::size_t>(column - 1)];
    parts.by_parameter = true;
    parts.linear_only = parts.linear_only && by.role == EffectRole::kLinear;
  }
  EffectSignature signature;
  for (const Application& application : applications(effect, data.joints())) {
    const MatrixXd variables = signals.variables(run, effect, application.target);
    VectorXd state = first_states(effect.law, variables);
    const EffectTorque torque =
        effect.law.evaluate(variables, effect.parameters, here.motion.sample_time, state, parts);
    for (std::size_t o = 0; o < application.outputs.size(); ++o) {
      const auto out = static_cast<Index>(o);
      MatrixXd columns(here.motion.samples(), static_cast<Index>(wanted.size()));
      for (Index c = 0; c < columns.cols(); ++c) {
        const int column = wanted[static_cast<std::size_t>(c)];
        if (column == 0) {
          columns.col(c) = torque.torque.col(out);
        } else {
          columns.col(c) = torque.by_parameter.col(out * np + column - 1);
        }
      }
      if (!data.acts_in(effect, run)) columns.setZero();
      signature.joints.push_back(application.outputs[o]);
      signature.columns.push_back(decimate(here.decimator, columns));
    }
  }
  return signature;
}

}  // namespace dyngen::runtime
