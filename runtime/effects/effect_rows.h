// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/estimation/rows.h"

namespace dyngen::runtime {

/// A model with effects and all their numbers.
struct EffectPoint {
  Eigen::VectorXd beta;                 ///< (nb)
  std::vector<EffectInstance> effects;  ///< parameters without NaN
  /// States before the first sample less what their laws begin with: initial[run][effect],
  /// (states) each.
  std::vector<std::vector<Eigen::VectorXd>> initial;
};

/// All states as their laws begin with them, in every run.
EffectPoint at_rest(const EffectRecordings& data, Eigen::VectorXd beta,
                    std::vector<EffectInstance> effects);

/// Which numbers of a point are looked for, and where they stand in one vector x: beta first, then
/// parameters of effects, then initial states. A logarithmic shape stands there as its logarithm.
struct EffectUnknowns {
  int base = 0;                              ///< nb
  std::vector<std::vector<int>> parameters;  ///< [effect][parameter]: place in x; -1: held
  std::vector<std::vector<int>> initial;     ///< [run][effect]: place of the first state; -1: held
  int size = 0;
};

/// beta alone.
EffectUnknowns base_unknowns(const EffectPoint& point);

/// Whether a parameter stands in x as its logarithm.
bool by_logarithm(const EffectParameter& parameter);

Eigen::VectorXd values_of(const EffectPoint& point, const EffectUnknowns& unknowns);
EffectPoint with_values(EffectPoint point, const EffectUnknowns& unknowns,
                        const Eigen::VectorXd& x);

/// How late the recorded torque of each joint is.
struct Alignment {
  Eigen::VectorXd delay;  ///< (n) s
  Eigen::VectorXd lag;    ///< (n) s
};
Alignment alignment_of(const std::vector<EffectInstance>& effects, int joints);

/// "stribeck 2", "motor_coupling 6<-5", "base_tilt"; joints from 1.
std::string short_name(const EffectInstance& effect);

/// Joints on which an effect acts, ascending; of a pair `joint` and then `other`.
std::vector<int> joints_of(const EffectInstance& effect, int joints);

/// Equations tau = J x around a point: exactly those of the model with effects at the point, and
/// their tangent elsewhere.
struct EffectEquations {
  std::vector<RowBlock> blocks;           ///< one a run; Y is J, (N x n * size)
  std::vector<std::vector<int>> columns;  ///< as LinearModel::columns, of J
  int size = 0;                           ///< of x

  [[nodiscard]] RowSource source() const;
};

/// J = [Y + d e/d beta, d e/d p, d e/d eta, d e/d z0], behind the parallel filter.
///
/// Effects with lateness act on the whole model. A delay is undone on the measured torque, by
/// interpolation; samples at the ends of a run that it does not reach have no equation. A lag is
/// applied to the model, 1 + T d/dt, since undoing it would take noise away.
/// @param signals  of the same recordings; its beta becomes the point's
EffectEquations linearised(const EffectRecordings& data, EffectSignals& signals,
                           const EffectPoint& point, const EffectUnknowns& unknowns);

/// The same equations of one joint in one run.
struct JointRows {
  Eigen::MatrixXd A;   ///< (N x m + 1) m columns of J, then tau; 0 where an equation is left out
  double counted = 0;  ///< equations that are not
};
struct PointEquations {
  std::vector<std::vector<JointRows>> joints;  ///< [joint][run]; none of a joint that is not asked
  std::vector<std::vector<int>> columns;       ///< as of EffectEquations
};

/// @param whole   of which joints all columns that can act on them are wanted
/// @param beside  of which joints those behind beta alone: the columns of effects
PointEquations equations_at(const EffectRecordings& data, EffectSignals& signals,
                            const EffectPoint& point, const EffectUnknowns& unknowns,
                            const std::vector<bool>& whole, const std::vector<bool>& beside);

/// Torque of one effect and its derivatives by parameters, behind the filter.
struct EffectSignature {
  std::vector<int> joints;               ///< on which it acts
  std::vector<Eigen::MatrixXd> columns;  ///< of each of these joints, (equations x wanted)
};
/// @param run          its states begin as first_states() says
/// @param wanted       0: the torque, 1 + p: its derivative by parameter p
/// @param states_held  as of EffectWanted
EffectSignature signature_of(const EffectRecordings& data, EffectSignals& signals, std::size_t run,
                             const EffectInstance& effect, const std::vector<int>& wanted,
                             bool states_held = false);

}  // namespace dyngen::runtime
