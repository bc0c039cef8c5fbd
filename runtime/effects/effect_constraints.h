// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/effects/effect_rows.h"
#include "runtime/estimation/inequalities.h"

namespace dyngen::runtime {

/// What an inequality is about.
struct ConstraintName {
  enum class Kind { kBound, kFriction, kRequirement, kDissipation, kInitial };
  Kind kind = Kind::kBound;
  int effect = -1;     ///< place; -1: of the model's own friction
  int parameter = -1;  ///< of kBound
  int joint = -1;      ///< of kFriction and kDissipation
  std::string text;    ///< "Fs >= 0", as people read it
};

/// Inequalities on the unknowns of a fit, linear or made so at a point.
struct EffectConstraints {
  Inequalities inequalities;
  std::vector<ConstraintName> names;  ///< of its rows
};

/// Sizes by which bounds are given, of every joint; what does not change with beta.
class ScaleTable {
 public:
  explicit ScaleTable(const EffectRecordings& data);

  /// @param joint  -1: the largest of all
  [[nodiscard]] EffectScales at(const Eigen::VectorXd& beta, int joint) const;
  [[nodiscard]] EffectScales of(const Eigen::VectorXd& beta, const EffectInstance& effect) const {
    return at(beta, effect.joint);
  }
  [[nodiscard]] const LinearModel& model() const { return model_; }

 private:
  const LinearModel& model_;
  std::vector<EffectScales> joints_;
  EffectScales largest_;
};

/// Bounds of parameters, requirements of the effects, Fc >= 0 and Fv >= 0 of joints with an effect
/// that dissipates, and there (Fc sign(v) + Fv v + e) sign(v) >= 0 on a grid of speeds up to the
/// largest one, for effects that read only qd, sign_qd, Fc and Fv; made linear at the point. A
/// requirement is made linear by central differences: exact if it is linear.
/// @param initial_reach  [effect] largest size of each state; initial states stay within
EffectConstraints constraints_at(const ScaleTable& scales, const EffectPoint& point,
                                 const EffectUnknowns& unknowns,
                                 const std::vector<Eigen::VectorXd>& initial_reach);

/// Brings parameters that are looked for within their bounds.
EffectPoint within_bounds(const ScaleTable& scales, EffectPoint point,
                          const EffectUnknowns& unknowns);

}  // namespace dyngen::runtime
