// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "runtime/estimation/robust_regression.h"
#include "runtime/rules/wind_up_rules.h"
#include "runtime/wind_up/wind_up.h"

namespace dyngen::runtime {

/// Something that may be in the wind-up beside the elastic twist.
struct WindUpTerm {
  enum class Kind { kHysteresis, kBacklash, kHardening, kLine };
  Kind kind = Kind::kHysteresis;
  Eigen::MatrixXd columns;  ///< (N x k)
  double shape = 0;         ///< reach, load or order
  std::string driver;       ///< of a hysteresis
  double chance = 1;        ///< of the term, if it is not there
  double left = 0;          ///< sum of squares with it
};

/// Orders of the angle that were looked at, and what none of them exceeds.
struct WindUpOrders {
  double least = 0, most = 0;  ///< periods per turn
  double below = 0;            ///< rad, of an amplitude with 95 %
};

/// The wind-up by least squares: offset, delay, load, slow gear error, rotor, and the terms that
/// pay for themselves.
class WindUpFit {
 public:
  /// Places of the parameters that every fit has; those of the slow gear error begin at kSlow.
  static constexpr Eigen::Index kOffset = 0, kDelay = 1, kLoad = 2, kSlow = 3;

  WindUpFit(const WindUpData& data, const WindUpRules& rules);

  /// Why the joint cannot be judged, in a sentence; empty: it can.
  [[nodiscard]] std::string why_not() const;
  /// Chooses the terms.
  void run();

  [[nodiscard]] const WindUpData& data() const { return data_; }
  [[nodiscard]] const WindUpRules& rules() const { return rules_; }
  [[nodiscard]] const RobustRegression& fit() const { return fit_; }
  [[nodiscard]] const std::vector<WindUpTerm>& terms() const { return terms_; }
  [[nodiscard]] const WindUpOrders& orders() const { return orders_; }
  /// (N x k) Columns of the slow gear error.
  [[nodiscard]] const Eigen::MatrixXd& slow() const { return slow_; }

  [[nodiscard]] bool has(WindUpTerm::Kind kind) const;
  [[nodiscard]] Eigen::Index rotor_place() const { return kSlow + slow_.cols(); }
  /// Place of the first term's first parameter.
  [[nodiscard]] Eigen::Index base_columns() const {
    return rotor_place() + (data_.rotor_open ? 1 : 0);
  }
  [[nodiscard]] Eigen::MatrixXd columns(const std::vector<WindUpTerm>& terms) const;
  [[nodiscard]] RobustRegression fit_of(const std::vector<WindUpTerm>& terms) const;
  /// Load without the rotor's part, if that is known.
  [[nodiscard]] Eigen::VectorXd net_load() const;
  /// Whether the load has both signs for long enough to show a gap.
  [[nodiscard]] bool reverses(const Eigen::VectorXd& load) const;
  /// The form that leaves least; its chance counts all of them.
  [[nodiscard]] std::optional<WindUpTerm> best_form(WindUpTerm::Kind kind) const;

 private:
  [[nodiscard]] Eigen::Index samples() const { return data_.wind_up.size(); }
  [[nodiscard]] double independent_rows() const;
  /// A signal delay_ ago, by its derivatives.
  [[nodiscard]] Eigen::VectorXd late(const Eigen::VectorXd& now, const Eigen::VectorXd& rate,
                                     const Eigen::VectorXd& second) const;
  /// Half a sample later, so that steps between samples have the signs of the rates at samples.
  [[nodiscard]] Eigen::VectorXd ahead(const Eigen::VectorXd& now,
                                      const Eigen::VectorXd& rate) const;
  [[nodiscard]] Eigen::VectorXd late_position() const;
  [[nodiscard]] Eigen::VectorXd late_load() const;
  void make_slow();
  void settle();
  [[nodiscard]] std::vector<WindUpTerm> forms_of(WindUpTerm::Kind kind) const;
  void choose_terms();
  void choose_lines();

  const WindUpData& data_;
  const WindUpRules& rules_;
  Eigen::VectorXd load_rate_, load_second_, jerk_, snap_;
  Eigen::MatrixXd slow_;
  double delay_ = 0;
  std::vector<WindUpTerm> terms_;
  RobustRegression fit_;
  WindUpOrders orders_;
};

}  // namespace dyngen::runtime
