// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "runtime/diagnosis/changes/session_equations.h"
#include "runtime/model/linear_model.h"
#include "runtime/rules/change_rules.h"

namespace dyngen::runtime {

/// Part of a column, or of its chi-square, that others must leave: less is rounding.
inline constexpr double kRoundingPart = 1e-9;

/// What scatters between sessions.
enum class ScatterKind { kCoulomb, kViscous, kOffset };
inline constexpr std::size_t kScatterKinds = 3;

/// A parameter that each session draws anew.
struct ScatterTerm {
  int column = 0;  ///< its place among the parameters
  int joint = 0;   ///< coordinate, from 0
  ScatterKind kind = ScatterKind::kCoulomb;
  double allowance = 0;  ///< standard deviation that is allowed, in the parameter's unit
};

/// The allowance of friction and offsets, relative to their size in the reference.
/// @param size    (nb) |parameter| of the reference
/// @param torque  (n) rms of the recorded torque
std::vector<ScatterTerm> scatter_terms(const LinearModel& model, const Eigen::VectorXd& size,
                                       const Eigen::VectorXd& torque, const ChangeRules& rules);

/// How far sessions differ without any change.
struct SessionScatter {
  std::vector<ScatterTerm> terms;
  /// Standard deviation of each kind over the allowance.
  std::array<double, kScatterKinds> factor{1, 1, 1};
  /// By which the variance of estimates is larger than the noise says, at least 1: halves of one
  /// session, or sessions of one side, that differ by more in all parameters.
  double inflation = 1;
  bool estimated = false;  ///< from several sessions of a side; else the allowance stands

  /// (terms) standard deviations. @param common  a factor on all of them
  [[nodiscard]] Eigen::VectorXd deviations(double common) const;
};

/// Sessions whitened by their noise and the scatter between them.
struct WhitenedSessions {
  Eigen::MatrixXd rows;  ///< [regressor, further columns, torque], sessions one below another
  Eigen::Index later_from = 0;  ///< the first row of a session after the reference
  double log_determinant = 0;   ///< of the covariance
};
WhitenedSessions whitened_sessions(const std::vector<SessionEquations>& sessions,
                                   const SessionScatter& scatter, double common);

/// The scatter that the sessions of each side show among themselves, by restricted likelihood; the
/// allowance where a side has no two sessions.
/// @param common  columns of A that both sides share
/// Source: Patterson and Thompson, "Recovery of inter-block information when block sizes are
/// unequal", Biometrika 1971.
SessionScatter session_scatter(const std::vector<SessionEquations>& sessions,
                               std::vector<ScatterTerm> terms, Eigen::Index common,
                               const ChangeRules& rules);

/// Columns that candidates add to those of the model, and what is left of them.
struct LeftOfSessions {
  Eigen::MatrixXd whole;  ///< (k x k) before the common columns are taken out
  Eigen::MatrixXd left;   ///< (k x k) after
  Eigen::VectorXd rest;   ///< (k) with the torque, after
  double restricted = 0;  ///< log of the restricted likelihood of the torque without them
};
/// @param columns    (K x k): each as a combination of A's columns in later sessions
/// @param reference  (K x k): the same in sessions of the reference
LeftOfSessions left_of_sessions(const WhitenedSessions& sessions, Eigen::Index common,
                                const Eigen::MatrixXd& columns, const Eigen::MatrixXd& reference);

}  // namespace dyngen::runtime
