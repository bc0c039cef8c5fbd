// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/effects/model_triangles.h"

namespace dyngen::runtime {

struct SearchOptions {
  int most_steps = 60;
  double tolerance = 1e-9;  ///< relative change of the cost at which it stops
};

/// Where a search is: a point, its equations and what they cost.
struct SearchState {
  EffectPoint point;
  TorqueFactor factor;  ///< of the equations made linear at the point, over the unknowns
  double cost = 0;      ///< sum over joints of (weight ||residual||)^2
  int steps = 0;
  bool converged = true;
};

/// The search for the least cost of a model with effects, by variable projection.
class EffectSearch {
 public:
  /// @param data, signals, triangles, scales  must outlive it
  EffectSearch(const EffectRecordings& data, EffectSignals& signals, ModelTriangles& triangles,
               const ScaleTable& scales, EffectUnknowns unknowns, Eigen::VectorXd joint_weights)
      : data_(data),
        signals_(signals),
        triangles_(triangles),
        scales_(scales),
        unknowns_(std::move(unknowns)),
        weights_(std::move(joint_weights)) {}

  /// beta and linear parameters at their best, everything else held. What effects read of the
  /// model moves with it, so that this takes some passes.
  [[nodiscard]] SearchState with_linear_solved(EffectPoint point) const;

  /// Levenberg and Marquardt from there.
  [[nodiscard]] SearchState run(EffectPoint start, const SearchOptions& options) const;

  /// Inequalities at a state: which it stands at, and the multipliers of those that hold it back
  /// (conditions of the first order).
  struct Held {
    EffectConstraints constraints;
    std::vector<bool> stands;
    Eigen::VectorXd multipliers;
  };
  [[nodiscard]] Held held_at(const SearchState& state) const;

  [[nodiscard]] EffectEquations equations_at(const EffectPoint& point) const {
    return linearised(data_, signals_, point, unknowns_);
  }
  [[nodiscard]] const EffectUnknowns& unknowns() const { return unknowns_; }
  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }

 private:
  /// A point whose linear unknowns are solved for: derivatives by others are not needed to compare
  /// it.
  struct Trial {
    EffectPoint point;
    double cost = 0;
  };
  [[nodiscard]] Trial tried(EffectPoint point) const;
  /// The equations over given unknowns, and the cost of the point in them.
  [[nodiscard]] SearchState evaluated(EffectPoint point, const EffectUnknowns& unknowns) const;
  [[nodiscard]] EffectConstraints constraints(const EffectPoint& point,
                                              const EffectUnknowns& unknowns) const;
  /// Unknowns in which the equations are not linear.
  [[nodiscard]] std::vector<int> places_of_shapes(const EffectPoint& point) const;

  const EffectRecordings& data_;
  EffectSignals& signals_;
  ModelTriangles& triangles_;
  const ScaleTable& scales_;
  EffectUnknowns unknowns_;
  Eigen::VectorXd weights_;
};

/// The largest size of each state of each effect over all runs, which begin at the point's states.
std::vector<Eigen::VectorXd> reach_of_states(const EffectRecordings& data, EffectSignals& signals,
                                             const EffectPoint& point);

}  // namespace dyngen::runtime
