// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/effects/effect_residual.h"
#include "runtime/effects/effect_search.h"
#include "runtime/effects/effect_start.h"
#include "runtime/estimation/covariance.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/identification/summary.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPreviewSteps = 8;  // of a search from one of several starts

RowSource source_of(const std::vector<RowBlock>& blocks) {
  return [&blocks](const std::function<void(const RowBlock&)>& visit) {
    for (const RowBlock& block : blocks) visit(block);
  };
}

class EffectFitter {
 public:
  EffectFitter(const EffectRecordings& data, const std::vector<EffectInstance>& effects,
               const EffectFitOptions& options, const EffectProgress& progress)
      : data_(data),
        written_(effects),
        options_(options),
        progress_(progress),
        signals_(data),
        triangles_(data),
        scales_(data) {}

  EffectFit run() {
    fit_without();
    EffectPoint point =
        at_rest(data_, fit_.beta_without, with_starts(scales_, fit_.beta_without, written_));
    signals_.set_beta(point.beta);
    signals_.set_tangent_beta(point.beta);
    unknowns_ = unknowns_of(point);
    point = within_bounds(scales_, std::move(point), unknowns_);
    for (std::size_t k = 0; k < written_.size(); ++k) point = started(point, k);
    SearchState state = EffectSearch(data_, signals_, triangles_, scales_, unknowns_, weights_)
                            .with_linear_solved(std::move(point));
    refuse_infinite(state);
    hold_steps(state);
    free_initial_states(state);
    state = searched(std::move(state));
    conclude(state);
    return std::move(fit_);
  }

 private:
  void tell(const std::string& what, double done) const {
    if (progress_) progress_(what, done);
  }

  /// The model alone: where the search begins, and what effects are measured against.
  void fit_without() {
    tell("the model without effects", 0);
    const EffectPoint nothing = at_rest(data_, VectorXd::Zero(data_.model.size()), {});
    const TorqueFactor factor = triangles_.at(signals_, nothing, base_unknowns(nothing));
    const VectorXd ones = VectorXd::Ones(data_.joints());
    const Estimate estimate =
        options_.weighted ? weighted_least_squares(factor) : least_squares(factor, ones);
    fit_.beta_without = estimate.beta;
    fit_.rms_without = estimate.residual_rms;
    weights_ = estimate.joint_weights;
  }

  /// All parameters but given ones and scanned ones with a number; no initial states.
  EffectUnknowns unknowns_of(const EffectPoint& point) const {
    EffectUnknowns unknowns = base_unknowns(point);
    for (std::size_t k = 0; k < written_.size(); ++k) {
      const auto& parameters = written_[k].law.parameters;
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        const EffectRole role = parameters[p].role;
        const bool number = !std::isnan(written_[k].parameters[static_cast<Index>(p)]);
        if (role == EffectRole::kGiven || (role == EffectRole::kScanned && number)) continue;
        unknowns.parameters[k][p] = unknowns.size++;
      }
    }
    return unknowns;
  }

  /// The point with the effect's shapes where the search may begin.
  EffectPoint started(const EffectPoint& point, std::size_t k) {
    tell("starting values of " + name_of(written_[k]),
         static_cast<double>(k) / static_cast<double>(written_.size()));
    const std::vector<VectorXd> starts = start_values(
        data_, signals_, scales_, point, k, written_[k], weights_, options_.grid, options_.refined);
    std::vector<EffectPoint> candidates;
    for (const VectorXd& start : starts) {
      candidates.push_back(point);
      candidates.back().effects[k].parameters = start;
    }
    if (candidates.size() == 1) return candidates.front();
    const EffectSearch search(data_, signals_, triangles_, scales_, unknowns_, weights_);
    std::optional<SearchState> best;
    for (EffectPoint& candidate : candidates) {
      SearchState state = search.run(std::move(candidate), {kPreviewSteps, options_.tolerance});
      if (!best || state.cost < best->cost) best = std::move(state);
    }
    return best->point;
  }

  /// @throws NotFiniteError  if the search cannot begin
  void refuse_infinite(const SearchState& state) const {
    if (std::isfinite(state.cost)) return;
    std::vector<std::string> names;
    for (const EffectInstance& effect : state.point.effects) names.push_back(short_name(effect));
    throw NotFiniteError(fmt::format(
        "fit_effects(): the torque of the model with {} is not finite at the parameters "
        "where the search begins: expected shapes at which it is",
        names.empty() ? "no effects" : fmt::format("{}", fmt::join(names, ", "))));
  }

  /// A scanned parameter in which torque is made of steps (when something begins) has no
  /// derivative: the value that the scan found is held.
  void hold_steps(const SearchState& state) {
    const VectorXd norms = column_norms(state.factor, weights_);
    int taken = 0;
    for (std::size_t k = 0; k < written_.size(); ++k) {
      for (std::size_t p = 0; p < unknowns_.parameters[k].size(); ++p) {
        int& place = unknowns_.parameters[k][p];
        if (place < 0) continue;
        const bool scanned = written_[k].law.parameters[p].role == EffectRole::kScanned;
        if (scanned && norms[place] == 0) {
          place = -1;
          ++taken;
        } else {
          place -= taken;
        }
      }
    }
    unknowns_.size -= taken;
  }

  /// Initial states that the recordings would notice become unknowns.
  void free_initial_states(const SearchState& state) {
    const std::vector<VectorXd> reach = reach_of_states(data_, signals_, state.point);
    EffectUnknowns all = unknowns_;
    for (std::size_t r = 0; r < data_.runs.size(); ++r) {
      for (std::size_t k = 0; k < written_.size(); ++k) {
        const int states = static_cast<int>(written_[k].law.states.size());
        if (states == 0 || !(reach[k].minCoeff() > 0)) continue;
        all.initial[r][k] = all.size;
        all.size += states;
      }
    }
    if (all.size == unknowns_.size) return;
    const TorqueFactor factor = triangles_.at(signals_, state.point, all);
    const VectorXd norms = column_norms(factor, weights_);
    for (std::size_t r = 0; r < data_.runs.size(); ++r) {
      for (std::size_t k = 0; k < written_.size(); ++k) {
        const int place = all.initial[r][k];
        if (place < 0) continue;
        // in standard deviations of white noise
        const double noticed =
            (norms.segment(place, reach[k].size()).cwiseProduct(reach[k])).norm();
        if (noticed < 1) continue;
        unknowns_.initial[r][k] = unknowns_.size;
        unknowns_.size += static_cast<int>(reach[k].size());
      }
    }
  }

  SearchState searched(SearchState state) {
    for (int round = 0; round < options_.most_rounds; ++round) {
      tell("fitting effects", static_cast<double>(round) / options_.most_rounds);
      signals_.set_tangent_beta(state.point.beta);
      const EffectSearch search(data_, signals_, triangles_, scales_, unknowns_, weights_);
      state = search.run(std::move(state.point), {options_.most_steps, options_.tolerance});
      fit_.steps += state.steps;
      fit_.converged = state.converged;
      if (!options_.weighted) break;
      const VectorXd next =
          residual_deviation(state.factor, values_of(state.point, unknowns_)).cwiseInverse();
      const double change = ((next - weights_).array() / next.array()).abs().maxCoeff();
      if (change < 1e-4) break;
      weights_ = next;
    }
    return state;
  }

  void conclude(SearchState state) {
    tell("noise and intervals", 0);
    const EffectSearch search(data_, signals_, triangles_, scales_, unknowns_, weights_);
    const EffectSearch::Held held = search.held_at(state);
    state.point = on_bounds(std::move(state.point), held);
    const VectorXd x = values_of(state.point, unknowns_);
    Estimate all = least_squares(state.factor, weights_);
    all.beta = x;
    unseen_ = unseen_among(all, unknowns_);
    fit_.remarks = effect_remarks(data_, scales_, state.point, unknowns_, all, held);
    all.unseen = with_constraints(all, held);
    const EffectEquations equations = search.equations_at(state.point);
    const NoiseFactor noise = options_.noise
                                  ? noise_factor(equations.source(), state.factor.columns,
                                                 state.factor.parameters, *options_.noise)
                                  : noise_at(all, state.factor, equations.source());
    all.covariance = correlated_covariance(state.factor, noise, weights_, all.scale, all.unseen);
    const VectorXd white =
        white_covariance(state.factor, x, weights_, all.scale, all.unseen).diagonal().cwiseSqrt();
    fit_.point = state.point;
    fit_.interval = interval_of(state.factor, noise);
    fit_.rms = residual_rms(equations.blocks, x);
    fit_.textbook = white.head(unknowns_.base);
    conclude_base(all);
    conclude_parameters(state.point, all, held);
  }

  /// A parameter that stands at a bound but for rounding is the bound.
  EffectPoint on_bounds(EffectPoint point, const EffectSearch::Held& held) const {
    for (std::size_t i = 0; i < held.stands.size(); ++i) {
      const ConstraintName& name = held.constraints.names[i];
      if (!held.stands[i] || name.kind != ConstraintName::Kind::kBound) continue;
      EffectInstance& effect = point.effects[static_cast<std::size_t>(name.effect)];
      const EffectSizes sizes = effect.law.sizes(scales_.of(point.beta, effect));
      double& value = effect.parameters[name.parameter];
      const double min = sizes.min[name.parameter], max = sizes.max[name.parameter];
      const double bound = std::abs(value - min) <= std::abs(value - max) ? min : max;
      if (std::isfinite(bound)) value = bound;
    }
    return point;
  }

  /// What the model's parameters are worth beside the effects.
  void conclude_base(const Estimate& all) {
    const std::vector<RowBlock> left = without_effects(data_, fit_.point);
    const TorqueFactor factor = factor_of(source_of(left), data_.model.columns, data_.model.size());
    fit_.base = least_squares(factor, weights_);
    fit_.base.beta = fit_.point.beta;
    fit_.base.residual_rms = fit_.rms;
    fit_.base.covariance = all.covariance.topLeftCorner(unknowns_.base, unknowns_.base);
  }

  /// Of values: where an unknown is a logarithm, by the chain rule.
  static MatrixXd covariance_of(const EffectInstance& effect, const std::vector<int>& places,
                                const MatrixXd& all) {
    const Index n = effect.law.size();
    MatrixXd chain = MatrixXd::Zero(n, all.rows());
    for (Index p = 0; p < n; ++p) {
      const auto place = static_cast<std::size_t>(p);
      if (places[place] < 0) continue;
      chain(p, places[place]) =
          by_logarithm(effect.law.parameters[place]) ? std::abs(effect.parameters[p]) : 1;
    }
    return chain * all * chain.transpose();
  }

  void conclude_parameters(const EffectPoint& point, const Estimate& all,
                           const EffectSearch::Held& held) {
    for (std::size_t k = 0; k < point.effects.size(); ++k) {
      const EffectInstance& effect = point.effects[k];
      fit_.parameters.emplace_back();
      fit_.covariance.push_back(covariance_of(effect, unknowns_.parameters[k], all.covariance));
      for (std::size_t p = 0; p < effect.law.parameters.size(); ++p) {
        EffectParameterFit parameter;
        parameter.value = effect.parameters[static_cast<Index>(p)];
        const int place = unknowns_.parameters[k][p];
        parameter.held = place < 0;
        if (place >= 0) {
          const auto own = static_cast<Index>(p);
          parameter.stddev = std::sqrt(fit_.covariance.back()(own, own));
          parameter.seen = !unseen_[static_cast<std::size_t>(place)];
          for (std::size_t i = 0; i < held.constraints.names.size(); ++i) {
            const ConstraintName& name = held.constraints.names[i];
            parameter.at_bound =
                parameter.at_bound ||
                (held.stands[i] && name.kind == ConstraintName::Kind::kBound &&
                 name.effect == static_cast<int>(k) && name.parameter == static_cast<int>(p));
          }
        }
        fit_.parameters.back().push_back(parameter);
      }
    }
  }

  /// Unseen directions, and those in which constraints hold the estimate.
  static MatrixXd with_constraints(const Estimate& all, const EffectSearch::Held& held) {
    std::vector<VectorXd> normals;
    for (Index i = 0; i < held.multipliers.size(); ++i) {
      if (!(held.multipliers[i] > 0)) continue;
      const VectorXd normal =
          all.scale.cwiseProduct(held.constraints.inequalities.G.row(i).transpose());
      normals.push_back(normal.normalized());
    }
    if (normals.empty()) return all.unseen;
    MatrixXd directions(all.scale.size(), all.unseen.cols() + static_cast<Index>(normals.size()));
    directions.leftCols(all.unseen.cols()) = all.unseen;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      directions.col(all.unseen.cols() + static_cast<Index>(i)) = normals[i];
    }
    const SingularValues svd = decomposed(directions);
    return svd.U.leftCols((svd.values.array() > 1e-9).count());
  }

  const EffectRecordings& data_;
  const std::vector<EffectInstance>& written_;
  const EffectFitOptions& options_;
  const EffectProgress& progress_;
  EffectSignals signals_;
  ModelTriangles triangles_;
  ScaleTable scales_;
  EffectUnknowns unknowns_;
  VectorXd weights_;
  std::vector<bool> unseen_;
  EffectFit fit_;
};

}  // namespace

void EffectFitOptions::validate() const {
  const auto demand = [](bool good, const char* name, double value, const char* range) {
    if (good) return;
    throw std::invalid_argument(
        fmt::format("EffectFitOptions: {} is {}, expected {}", name, value, range));
  };
  demand(most_rounds >= 1, "most_rounds", most_rounds, "1 or more");
  demand(most_steps >= 1, "most_steps", most_steps, "1 or more");
  demand(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "a number in (0, 1)");
  demand(refined >= 1, "refined", refined, "1 or more");
  demand(grid >= 1, "grid", grid, "1 or more");
}

bool EffectFit::objects(const EffectRemark& remark, int effect) const {
  if (remark.effect != effect || remark.kind == EffectRemark::Kind::kUnusual) return false;
  if (remark.kind != EffectRemark::Kind::kNotSeen) return true;
  const auto place = static_cast<std::size_t>(effect);
  const std::vector<EffectParameter>& described = point.effects[place].law.parameters;
  for (std::size_t p = 0; p < described.size(); ++p) {
    const EffectParameterFit& own = parameters[place][p];
    if (described[p].role == EffectRole::kLinear && own.seen && !own.held) return false;
  }
  return true;
}

bool EffectFit::all_seen() const {
  return std::none_of(remarks.begin(), remarks.end(), [](const EffectRemark& remark) {
    return remark.kind == EffectRemark::Kind::kNotSeen;
  });
}

EffectFit fit_effects(const EffectRecordings& data, const std::vector<EffectInstance>& effects,
                      const EffectFitOptions& options, const EffectProgress& progress) {
  options.validate();
  return EffectFitter(data, effects, options, progress).run();
}

}  // namespace dyngen::runtime
