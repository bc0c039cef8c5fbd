// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "runtime/estimation/whitener.h"
#include "runtime/evidence/joint_columns.h"
#include "runtime/evidence/local_reflections.h"
#include "runtime/evidence/torque_noise_model.h"
#include "runtime/evidence/unknown_torque.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Products of whitened columns with one another and with what the model leaves, after projection.
struct Products {
  Eigen::MatrixXd whole;  ///< (k x k) C'C, before projection
  Eigen::MatrixXd left;   ///< (k x k) C'MC, M takes out what the model can absorb
  Eigen::VectorXd rest;   ///< (k) C'Mr
  Eigen::MatrixXd noise;  ///< (k x m) C'M of each noise surrogate
};

/// What columns explain beside the model.
struct Score {
  double delta_chi2 = 0;         ///< r'P r: the chi-square reduction
  int degrees = 0;               ///< independent columns that the model does not absorb
  double part_left = 0;          ///< of the columns' sum of squares, after projection over before
  Eigen::VectorXd coefficients;  ///< (k) of the columns; 0 of those that are absorbed
  Eigen::VectorXd surrogates;    ///< (m) chi-square reduction of the noise surrogates
};
/// @param surrogates  false: those are left out
Score score_of(const Products& products, bool surrogates = true);

/// Chi-square reductions of columns that are selected one by one, each the best beside those before
/// it: of m columns at place m - 1, as many as are independent.
std::vector<double> squares_of_few(const Products& products);

/// The equations of a model, whitened: regressor, columns of effects that belong to it by now, what
/// they leave of the torque, and noise of the same kind, projected alike.
///
/// After whitening noise is white and of unit variance, so that a surrogate of the recordings under
/// "nothing is left out" is a vector of standard normal numbers. In stiction intervals
/// (EffectRun::unknown), the effect of any torque there is projected out of all of them.
class EvidenceSystem {
 public:
  struct Options {
    int surrogates = 32;
    std::uint64_t seed = 1;
    bool with_regressor = true;  ///< false: no parameter of the model is fitted
    DecisionRules rules;
  };

  /// @param residuals  of the torque to explain: at the model, or all of it; what the regressor
  ///                   spans is taken out
  EvidenceSystem(const EffectRecordings& data, const RunResiduals& residuals,
                 const TorqueNoiseModel& noise, const Options& options);

  [[nodiscard]] JointColumns whitened(JointColumns columns) const;
  /// Whitened columns become part of the model.
  void add(const JointColumns& whitened);
  /// So do those of one joint of which each is 0 but for a few consecutive rows; a joint has them
  /// once. Columns have to be whitened again: what these span is taken out of them there.
  void leave_out(const JointColumns& whitened);

  [[nodiscard]] Products products(const JointColumns& whitened, bool surrogates = true) const;
  /// Of consecutive groups of columns, each by itself: one pass over the model's columns for all.
  /// @param width  columns of a group
  [[nodiscard]] std::vector<Products> products_of_groups(const JointColumns& whitened,
                                                         Eigen::Index width, bool surrogates) const;
  /// The same over a range of rows of every joint alone. @param from, to  as fractions of no run:
  /// rows of a joint, [from, to)
  [[nodiscard]] Products products(const JointColumns& whitened, Eigen::Index from, Eigen::Index to,
                                  bool surrogates) const;

  /// What the model leaves of a joint, whitened. @return (equations)
  [[nodiscard]] Eigen::VectorXd rest(int joint) const;
  /// What it leaves of the noise surrogates. @return (equations x m)
  [[nodiscard]] Eigen::MatrixXd noise(int joint) const;
  /// Whitened columns less what the model absorbs, of one joint. @return (equations x k)
  [[nodiscard]] Eigen::MatrixXd left_of(const JointColumns& whitened, int joint) const;
  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  [[nodiscard]] Eigen::Index rank() const { return basis_.cols(); }
  /// (n) degrees of freedom that the model takes from each joint.
  [[nodiscard]] Eigen::VectorXd taken() const;
  /// Inner products of the basis with whitened columns. @return (rank x k)
  [[nodiscard]] Eigen::MatrixXd absorbed(const JointColumns& whitened, Eigen::Index from,
                                         Eigen::Index to) const;
  /// Independent samples that the noise of a joint is known by.
  /// Independent samples that a joint's noise is known by; many of a joint without equations, which
  /// limits no test.
  [[nodiscard]] double worth(int joint) const { return worth_[joint] > 0 ? worth_[joint] : kMany; }
  /// Those of scans.
  [[nodiscard]] const ScanRules& rules() const { return rules_; }
  [[nodiscard]] const PriorRules& priors() const { return priors_; }
  [[nodiscard]] int surrogates() const { return static_cast<int>(noise_.cols()); }

 private:
  void whiten(Eigen::Ref<Eigen::MatrixXd> rows, int joint) const;
  void take_out_unknown(Eigen::Ref<Eigen::MatrixXd> rows, int joint) const;
  void project(const Eigen::MatrixXd& columns);
  /// Of columns with the model's and one another, or with the surrogates, over rows of each joint.
  void count_products(const JointColumns& whitened, Eigen::Index rows, bool with_surrogates) const;

  const EffectRecordings& data_;
  ScanRules rules_;
  PriorRules priors_;
  std::shared_ptr<const std::vector<std::vector<Whitener>>>
      whiteners_;  // of each joint in each run
  std::shared_ptr<const std::vector<std::deque<UnknownTorque>>> unknown_;  // the same
  std::vector<std::shared_ptr<const LocalReflections>> left_out_;  // of each joint; or nothing
  static constexpr double kMany = 1e9;
  Eigen::VectorXd worth_;  // (n)
  Eigen::Index rows_ = 0;  // of one joint
  Eigen::MatrixXd basis_;  // (n rows x rank) orthonormal
  Eigen::VectorXd rest_;   // (n rows)
  Eigen::MatrixXd noise_;  // (n rows x m)
};

}  // namespace dyngen::runtime
