// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/inequalities.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPasses = 5;                 // over linear unknowns, where effects read the model
constexpr double kSearchRounding = 1e-12;  // of the cost: two that differ by less are alike

/// The unknowns at least squares within inequalities. @param x  where the search for them begins
VectorXd solved(const MatrixXd& W, const VectorXd& tau, const Inequalities& inequalities,
                const VectorXd& x) {
  // rows that no unknown can change say nothing here
  std::vector<Index> kept;
  for (Index i = 0; i < inequalities.h.size(); ++i) {
    if (!inequalities.G.row(i).isZero(0)) kept.push_back(i);
  }
  Inequalities own;
  if (!kept.empty()) own = {inequalities.G(kept, Eigen::all), inequalities.h(kept)};
  return constrained_least_squares(W, tau, own, x).x;
}

bool is_linear(const EffectInstance& effect, std::size_t parameter) {
  return effect.law.kind != EffectKind::kAlignment &&
         effect.law.parameters[parameter].role == EffectRole::kLinear;
}

/// Of unknowns those in which the equations are linear.
EffectUnknowns linear_among(const EffectUnknowns& unknowns, const EffectPoint& point) {
  EffectUnknowns linear = base_unknowns(point);
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    for (std::size_t p = 0; p < unknowns.parameters[k].size(); ++p) {
      if (unknowns.parameters[k][p] < 0 || !is_linear(point.effects[k], p)) continue;
      linear.parameters[k][p] = linear.size++;
    }
  }
  return linear;
}

/// Whether the equations are linear in linear unknowns however far these go: no effect reads a
/// number of the model, or where its own number takes it.
bool exactly_linear(const EffectPoint& point) {
  return std::none_of(point.effects.begin(), point.effects.end(), [](const EffectInstance& effect) {
    const auto& names = effect.law.variables;
    return effect.law.midpoint >= 0 || std::any_of(names.begin(), names.end(), depends_on_model);
  });
}

}  // namespace

std::vector<VectorXd> reach_of_states(const EffectRecordings& data, EffectSignals& signals,
                                      const EffectPoint& point) {
  constexpr Index kLooks = 50;  // times in a run at which states are looked at
  std::vector<VectorXd> reach;
  signals.set_beta(point.beta);
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    reach.push_back(VectorXd::Zero(static_cast<Index>(effect.law.states.size())));
    if (effect.law.states.empty()) continue;
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      const MatrixXd variables = signals.variables(run, effect, effect.joint);
      VectorXd state = point.initial[run][k] + first_states(effect.law, variables);
      const Index piece = std::max<Index>(1, variables.rows() / kLooks);
      for (Index start = 0; start < variables.rows(); start += piece) {
        effect.law.evaluate(variables.middleRows(start, std::min(piece, variables.rows() - start)),
                            effect.parameters, data.runs[run].motion.sample_time, state, {});
        if (state.allFinite()) reach.back() = reach.back().cwiseMax(state.cwiseAbs());
      }
    }
  }
  return reach;
}

EffectConstraints EffectSearch::constraints(const EffectPoint& point,
                                            const EffectUnknowns& unknowns) const {
  std::vector<VectorXd> reach;
  const bool any = std::any_of(unknowns.initial.begin(), unknowns.initial.end(), [](auto& run) {
    return std::any_of(run.begin(), run.end(), [](int place) { return place >= 0; });
  });
  if (any) {
    reach = reach_of_states(data_, signals_, point);
  } else {
    reach.resize(point.effects.size());
  }
  return constraints_at(scales_, point, unknowns, reach);
}

std::vector<int> EffectSearch::places_of_shapes(const EffectPoint& point) const {
  std::vector<bool> shapes(static_cast<std::size_t>(unknowns_.size), true);
  std::fill_n(shapes.begin(), unknowns_.base, false);
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    for (std::size_t p = 0; p < unknowns_.parameters[k].size(); ++p) {
      const int place = unknowns_.parameters[k][p];
      if (place >= 0 && is_linear(point.effects[k], p)) {
        shapes[static_cast<std::size_t>(place)] = false;
      }
    }
  }
  std::vector<int> result;
  for (int i = 0; i < unknowns_.size; ++i) {
    if (shapes[static_cast<std::size_t>(i)]) result.push_back(i);
  }
  return result;
}

SearchState EffectSearch::evaluated(EffectPoint point, const EffectUnknowns& unknowns) const {
  SearchState state;
  data_.count_work(data_.equations() * data_.joints(), unknowns.size, unknowns.size);
  state.factor = triangles_.at(signals_, point, unknowns);
  state.cost = residual_squares(state.factor, values_of(point, unknowns)).dot(weights_.cwiseAbs2());
  if (!std::isfinite(state.cost)) state.cost = std::numeric_limits<double>::infinity();
  state.point = std::move(point);
  return state;
}

EffectSearch::Trial EffectSearch::tried(EffectPoint point) const {
  const EffectUnknowns linear = linear_among(unknowns_, point);
  const bool exact = exactly_linear(point);
  SearchState best = evaluated(std::move(point), linear);
  bool first = true;
  for (int pass = 0; pass < kPasses && std::isfinite(best.cost); ++pass) {
    const StackedRows rows = stacked(best.factor, weights_);
    const VectorXd x = solved(rows.W, rows.tau, constraints(best.point, linear).inequalities,
                              values_of(best.point, linear));
    const double promised = (rows.W * x - rows.tau).squaredNorm();
    EffectPoint solved = with_values(best.point, linear, x);
    if (exact) return {std::move(solved), promised};
    SearchState next = evaluated(std::move(solved), linear);
    const bool as_promised = std::abs(next.cost - promised) <= 1e-10 * promised + 1e-300;
    // the first solution also brings an infeasible start within its constraints: it may cost more
    if (!first && next.cost > best.cost) break;
    const double gain = best.cost - next.cost;
    best = std::move(next);
    if (as_promised || (!first && gain <= 1e-10 * best.cost)) break;
    first = false;
  }
  return {std::move(best.point), best.cost};
}

SearchState EffectSearch::with_linear_solved(EffectPoint point) const {
  return evaluated(tried(std::move(point)).point, unknowns_);
}

SearchState EffectSearch::run(EffectPoint start, const SearchOptions& options) const {
  constexpr double kMostDamping = 1e8;
  SearchState state = with_linear_solved(within_bounds(scales_, std::move(start), unknowns_));
  const std::vector<int> shapes = places_of_shapes(state.point);
  if (shapes.empty()) return state;
  double damping = 1e-3;
  state.converged = false;
  int steps = 0;
  while (steps < options.most_steps) {
    const VectorXd x = values_of(state.point, unknowns_);
    const StackedRows rows = stacked(state.factor, weights_);
    const Inequalities inequalities = constraints(state.point, unknowns_).inequalities;
    bool better = false;
    for (; !better && damping < kMostDamping && steps < options.most_steps; ++steps) {
      const Index count = static_cast<Index>(shapes.size());
      MatrixXd A(rows.W.rows() + count, unknowns_.size);
      A << rows.W, MatrixXd::Zero(count, unknowns_.size);
      VectorXd b(A.rows());
      b << rows.tau, VectorXd::Zero(count);
      for (Index i = 0; i < count; ++i) {
        const int place = shapes[static_cast<std::size_t>(i)];
        const double size = std::sqrt(damping) * rows.W.col(place).norm();
        A(rows.W.rows() + i, place) = size;
        b[rows.W.rows() + i] = size * x[place];
      }
      const VectorXd step = solved(A, b, inequalities, x) - x;
      Trial next =
          tried(within_bounds(scales_, with_values(state.point, unknowns_, x + step), unknowns_));
      const double gain = state.cost - next.cost;
      if (gain > -kSearchRounding * state.cost) {
        better = true;
        damping = std::max(1e-9, damping / 6);
        state.converged = gain <= options.tolerance * state.cost;
        if (gain > 0) {
          const bool converged = state.converged;
          state = evaluated(std::move(next.point), unknowns_);
          state.converged = converged;
        }
      } else {
        damping *= 4;
      }
    }
    // no step of any length is better: it is the minimum, as far as rounding tells
    if (!better && damping >= kMostDamping) state.converged = true;
    if (!better || state.converged) break;
  }
  state.steps = steps;
  return state;
}

EffectSearch::Held EffectSearch::held_at(const SearchState& state) const {
  constexpr double kAt = 1e-7;     // relative: an inequality that the point stands at
  constexpr double kHolds = 1e-6;  // of the gradient: what is less is rounding
  Held held;
  held.constraints = constraints(state.point, unknowns_);
  const Inequalities& inequalities = held.constraints.inequalities;
  const StackedRows rows = stacked(state.factor, weights_);
  const VectorXd x = values_of(state.point, unknowns_);
  held.stands = std::vector<bool>(held.constraints.names.size(), false);
  held.multipliers = VectorXd::Zero(inequalities.h.size());
  std::vector<Index> active;
  for (Index i = 0; i < inequalities.h.size(); ++i) {
    const double slack = inequalities.G.row(i).dot(x) - inequalities.h[i];
    const double size =
        inequalities.G.row(i).cwiseAbs().dot(x.cwiseAbs()) + std::abs(inequalities.h[i]);
    if (slack > kAt * size + 1e-12) continue;
    active.push_back(i);
    held.stands[static_cast<std::size_t>(i)] = true;
  }
  if (active.empty()) return held;
  // half the gradient of the cost is a sum of the inequalities' normals, in scaled unknowns
  const VectorXd scale = unit_scale(rows.W);
  const VectorXd gradient = scale.cwiseProduct(rows.W.transpose() * (rows.W * x - rows.tau));
  MatrixXd normals = (inequalities.G(active, Eigen::all) * scale.asDiagonal()).transpose();
  const VectorXd lengths = normals.colwise().norm().cwiseMax(1e-300);
  normals = normals * lengths.cwiseInverse().asDiagonal();
  const VectorXd forces = nonnegative_least_squares(normals, gradient).x;
  const double least = kHolds * (1e-6 * std::sqrt(state.cost) + gradient.norm());
  for (std::size_t i = 0; i < active.size(); ++i) {
    const double force = forces[static_cast<Index>(i)];
    if (force > least) held.multipliers[active[i]] = force / lengths[static_cast<Index>(i)];
  }
  return held;
}

}  // namespace dyngen::runtime
