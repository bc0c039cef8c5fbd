// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "gen/effect_file/effect_file.h"
#include "gen/effect_programs/effect_programs.h"
#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

/// Evaluates the programs of an effect over runs of samples: EffectLaw::evaluate. A copy shares the
/// programs; any number of threads may call it.
class EffectEvaluation {
 public:
  explicit EffectEvaluation(const EffectFile& effect);

  /// As of EffectLaw::evaluate. @throws std::invalid_argument  if a size does not fit the effect
  EffectTorque operator()(const Eigen::MatrixXd& variables, const Eigen::VectorXd& parameters,
                          double sample_time, Eigen::VectorXd& state,
                          const EffectWanted& wanted) const;

  [[nodiscard]] bool is_proportional() const { return programs_->proportional; }

 private:
  /// States at every sample, and their derivatives: element (state s, by k) in column s * count +
  /// k.
  struct History {
    Eigen::MatrixXd z, by_parameter, by_constant, by_initial;
  };
  /// What the steps of a run have in common.
  struct StepInputs {
    const Eigen::MatrixXd& middle;      ///< (N x nv) variables in the middle of each step
    const Eigen::VectorXd& parameters;  ///< (np)
    double sample_time;                 ///< s; the first step has no length
  };
  using Outputs = std::vector<std::pair<const char*, Eigen::Index>>;  // arrays and their columns

  void check(const Eigen::MatrixXd& variables, const Eigen::VectorXd& parameters,
             const Eigen::VectorXd& state) const;
  void add_memory(const Eigen::MatrixXd& by_state, const Eigen::MatrixXd& of_states, Eigen::Index k,
                  Eigen::Index count, Eigen::MatrixXd& slopes, Eigen::Index column) const;
  History follow(const Eigen::MatrixXd& variables, const Eigen::VectorXd& parameters,
                 double sample_time, Eigen::VectorXd& state, const EffectWanted& wanted) const;
  static std::vector<Eigen::MatrixXd> of_steps(const Program& program, const StepInputs& inputs,
                                               const Eigen::MatrixXd* before,
                                               const Outputs& outputs);
  [[nodiscard]] Eigen::MatrixXd remembered(const Eigen::MatrixXd& by_z, Eigen::MatrixXd b,
                                           const Eigen::MatrixXd& start) const;

  std::shared_ptr<const EffectPrograms> programs_;
  std::vector<bool> linear_;  // of each parameter
  Eigen::Index variables_, parameters_, states_, outputs_;
  std::vector<Eigen::Index> constants_;  // Fc, Fv, Ia: their places among the variables
};

}  // namespace dyngen::runtime
