// SPDX-License-Identifier: MIT
#include "tests/baselines/baselines.h"

#include <Eigen/QR>
#include <algorithm>
#include <functional>
#include <stdexcept>

#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/effects/equation_stack.h"
#include "runtime/recordings/spline.h"
#include "tests/baselines/effect_dictionary.h"
#include "tests/baselines/friction_ladder.h"
#include "tests/baselines/splines.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectRecordings;
using runtime::EffectRun;
using runtime::RunResiduals;

constexpr int kPieces = 12;       // of a spline
constexpr double kRank = 1e-8;    // of the equations, columns of unit length
constexpr double kFastest = 0.9;  // of the samples are slower

/// Torque of one column: (N x n) of each run, at every sample.
using Column = std::function<RunResiduals(const EffectRecordings& data)>;

using Solver = Eigen::CompleteOrthogonalDecomposition<MatrixXd>;

/// Least squares by columns of any length; what they do not determine is 0.
class LeastSquares {
 public:
  explicit LeastSquares(const MatrixXd& A) : scale_(A.colwise().norm().transpose()) {
    for (double& s : scale_) s = s > 0 ? 1 / s : 1;
    solver_.setThreshold(kRank);
    solver_.compute(A * scale_.asDiagonal());
  }
  [[nodiscard]] MatrixXd solve(const MatrixXd& right) const {
    return scale_.asDiagonal() * solver_.solve(right);
  }

 private:
  VectorXd scale_;
  Solver solver_;
};

/// What is added to the base model, and how much of it.
struct Addition {
  std::vector<Column> columns;
  VectorXd amounts;
  VectorXd beta;
};

/// Recordings as weighted equations, and what a model leaves of held-out ones.
class Equations {
 public:
  Equations(const EffectRecordings& train, const EffectRecordings& heldout)
      : train_(train),
        heldout_(heldout),
        fit_(runtime::fit_effects(train, {})),
        stack_(train, runtime::Whitening::by_weights(fit_.rms.cwiseInverse())) {
    runtime::EffectSignals signals(train);
    const runtime::EffectPoint nothing = runtime::at_rest(train, fit_.point.beta, {});
    const MatrixXd all = stack_.stacked(
        runtime::linearised(train, signals, nothing, runtime::base_unknowns(nothing)));
    base_ = all.leftCols(train.model.size());
    torque_ = all.rightCols(1);
    const int last = train.runs.back().recording;
    for (int j = 0; j < train.joints(); ++j) {
      Index row = stack_.first(j);
      for (const EffectRun& run : train.runs) {
        for (Index k = 0; k < run.rows.Y.rows(); ++k, ++row) {
          (run.recording == last ? checked_ : fitted_).push_back(row);
        }
      }
    }
    if (fitted_.empty()) {
      throw std::invalid_argument("baselines: found one recording, expected two at least");
    }
  }

  [[nodiscard]] const VectorXd& beta() const { return fit_.point.beta; }
  [[nodiscard]] const MatrixXd& base() const { return base_; }
  [[nodiscard]] const VectorXd& torque() const { return torque_; }
  /// Rows of all recordings but the last, and of the last.
  [[nodiscard]] const std::vector<Index>& fitted() const { return fitted_; }
  [[nodiscard]] const std::vector<Index>& checked() const { return checked_; }
  [[nodiscard]] Index first(int joint) const { return stack_.first(joint); }
  [[nodiscard]] Index of_joint() const { return stack_.of_joint(); }

  /// Behind the parallel filter, weighted. @return (equations)
  [[nodiscard]] VectorXd stacked(const Column& column) const {
    const RunResiduals torque = column(train_);
    VectorXd plain(stack_.rows());
    for (int j = 0; j < train_.joints(); ++j) {
      Index row = stack_.first(j);
      for (std::size_t run = 0; run < train_.runs.size(); ++run) {
        const EffectRun& here = train_.runs[run];
        plain.segment(row, here.rows.Y.rows()) =
            runtime::decimate(here.decimator, torque[run].col(j));
        row += here.rows.Y.rows();
      }
    }
    return stack_.whitened(plain);
  }

  /// Columns beside the base model, all fitted together.
  [[nodiscard]] Addition refitted(std::vector<Column> columns) const {
    MatrixXd all(stack_.rows(), base_.cols() + static_cast<Index>(columns.size()));
    all.leftCols(base_.cols()) = base_;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      all.col(base_.cols() + static_cast<Index>(c)) = stacked(columns[c]);
    }
    const VectorXd x = LeastSquares(all).solve(torque_);
    return {std::move(columns), x.tail(x.size() - base_.cols()), x.head(base_.cols())};
  }

  /// (n) of recordings that were not fitted.
  [[nodiscard]] VectorXd heldout_rms(const Addition& addition) const {
    RunResiduals left =
        runtime::raw_residuals(heldout_, runtime::at_rest(heldout_, addition.beta, {}));
    for (std::size_t c = 0; c < addition.columns.size(); ++c) {
      const RunResiduals torque = addition.columns[c](heldout_);
      for (std::size_t run = 0; run < left.size(); ++run) {
        left[run] -= addition.amounts[static_cast<Index>(c)] * torque[run];
      }
    }
    return runtime::raw_rms(heldout_, left);
  }

 private:
  const EffectRecordings& train_;
  const EffectRecordings& heldout_;
  runtime::EffectFit fit_;
  runtime::EquationStack stack_;
  MatrixXd base_;
  VectorXd torque_;
  std::vector<Index> fitted_, checked_;
};

/// An effect as it stands. What makes torque late acts through the rate of what the filter passes:
/// friction's jump has none of its own.
Column effect_column(const EffectInstance& effect, const VectorXd& beta) {
  return [effect, beta](const EffectRecordings& data) {
    const bool late = effect.law.kind == runtime::EffectKind::kAlignment;
    EffectRecordings raw = data;
    for (EffectRun& run : raw.runs) {
      if (!late) run.decimator = runtime::design_decimator(1);
    }
    runtime::EffectSignals signals(raw);
    signals.set_beta(beta);
    signals.set_tangent_beta(beta);
    RunResiduals torque;
    for (std::size_t run = 0; run < raw.runs.size(); ++run) {
      const runtime::EffectSignature own = runtime::signature_of(raw, signals, run, effect, {0});
      const EffectRun& here = data.runs[run];
      torque.push_back(MatrixXd::Zero(here.motion.samples(), data.joints()));
      for (std::size_t i = 0; i < own.joints.size(); ++i) {
        VectorXd column = own.columns[i].col(0);
        if (late && column.size() > 1) {
          const Index first = runtime::first_sample(here.decimator);
          const VectorXd at = here.time(Eigen::seqN(first, column.size(), here.decimator.factor));
          column = runtime::interpolate_spline(
              at, column, here.time.cwiseMax(at[0]).cwiseMin(at[at.size() - 1]));
        }
        if (column.size() == torque.back().rows()) torque.back().col(own.joints[i]) += column;
      }
    }
    return torque;
  };
}

/// Of one joint, a function of its motion in a run.
Column joint_column(int joint, std::function<VectorXd(const EffectRun&)> torque) {
  return [joint, torque = std::move(torque)](const EffectRecordings& data) {
    RunResiduals all;
    for (const EffectRun& run : data.runs) {
      all.push_back(MatrixXd::Zero(run.motion.samples(), data.joints()));
      all.back().col(joint) = torque(run);
    }
    return all;
  };
}

/// What a joint does in recordings.
struct Range {
  double low = 0, high = 0;  // rad or m
  double fast = 0;           // that 90 % of the samples are slower than
  double fastest = 0;
};

Range range_of(const EffectRecordings& data, int joint) {
  Range range;
  range.low = range.high = data.runs.front().motion.q(0, joint);
  std::vector<double> speeds;
  for (const EffectRun& run : data.runs) {
    range.low = std::min(range.low, run.motion.q.col(joint).minCoeff());
    range.high = std::max(range.high, run.motion.q.col(joint).maxCoeff());
    for (const double v : run.motion.dq.col(joint)) speeds.push_back(std::abs(v));
  }
  std::sort(speeds.begin(), speeds.end());
  range.fastest = speeds.back();
  range.fast = speeds[static_cast<std::size_t>(kFastest * static_cast<double>(speeds.size() - 1))];
  return range;
}

std::vector<BaselineResult::Name> without_repeats(const std::vector<BaselineResult::Name>& names) {
  std::vector<BaselineResult::Name> once;
  for (const auto& name : names) {
    const bool known = std::any_of(once.begin(), once.end(), [&](const auto& other) {
      return other.family == name.family && other.joint == name.joint;
    });
    if (!known) once.push_back(name);
  }
  return once;
}

BaselineResult of_effects(const std::string& baseline, const Equations& equations,
                          const EffectDictionary& dictionary, const std::vector<Index>& places) {
  BaselineResult result{baseline, {}, {}};
  std::vector<Column> columns;
  for (const Index place : places) {
    const EffectInstance& effect = dictionary.effects[static_cast<std::size_t>(place)];
    result.names.push_back({effect.law.family, effect.joint + 1});
    columns.push_back(effect_column(effect, equations.beta()));
  }
  result.names = without_repeats(result.names);
  result.heldout_rms = equations.heldout_rms(equations.refitted(std::move(columns)));
  return result;
}

BaselineResult of_splines(const Equations& equations, const EffectRecordings& train) {
  Addition addition{{}, {}, equations.beta()};
  const VectorXd left = equations.torque() - equations.base() * equations.beta();
  for (int j = 0; j < train.joints(); ++j) {
    const Range range = range_of(train, j);
    if (!(range.low < range.high)) continue;
    const Index pieces = 2 * (kPieces + 3);
    MatrixXd basis(equations.of_joint(), pieces);
    std::vector<Column> columns;
    for (Index c = 0; c < pieces; ++c) {
      columns.push_back(joint_column(j, [range, j, c](const EffectRun& run) -> VectorXd {
        const bool of_speed = c > kPieces + 2;
        return of_speed
                   ? cubic_splines(run.motion.dq.col(j), -range.fastest, range.fastest, kPieces)
                         .col(c - kPieces - 3)
                   : cubic_splines(run.motion.q.col(j), range.low, range.high, kPieces).col(c);
      }));
      basis.col(c) =
          equations.stacked(columns.back()).segment(equations.first(j), equations.of_joint());
    }
    const VectorXd own = left.segment(equations.first(j), equations.of_joint());
    std::vector<Index> fitted, checked;
    for (const auto& [all, some] :
         {std::pair(&equations.fitted(), &fitted), std::pair(&equations.checked(), &checked)}) {
      for (const Index row : *all) {
        const Index place = row - equations.first(j);
        if (place >= 0 && place < equations.of_joint()) some->push_back(place);
      }
    }
    const double penalty = penalty_by_validation(basis(fitted, Eigen::all), own(fitted),
                                                 basis(checked, Eigen::all), own(checked));
    const Index before = addition.amounts.size();
    addition.amounts.conservativeResize(before + pieces);
    addition.amounts.tail(pieces) = ridge_solution(basis, own, penalty);
    addition.columns.insert(addition.columns.end(), columns.begin(), columns.end());
  }
  return {"spline", {}, equations.heldout_rms(addition)};
}

BaselineResult of_ladder(const Equations& equations, const EffectRecordings& train) {
  const MatrixXd base = equations.base()(equations.fitted(), Eigen::all);
  const MatrixXd checked_base = equations.base()(equations.checked(), Eigen::all);
  const LeastSquares model(base);
  const VectorXd beta = model.solve(equations.torque()(equations.fitted()));
  const VectorXd left = equations.torque()(equations.fitted()) - base * beta;
  const VectorXd checked_left = equations.torque()(equations.checked()) - checked_base * beta;
  BaselineResult result{"ladder", {}, {}};
  std::vector<Column> chosen;
  for (int j = 0; j < train.joints(); ++j) {
    const Range range = range_of(train, j);
    const auto rungs = friction_ladder(range.fast, range.high - range.low);
    const auto column_of = [&](const FrictionTerm& term) {
      return joint_column(j, [term, j](const EffectRun& run) {
        return friction_column(term, run.motion.dq.col(j), run.motion.sample_time);
      });
    };
    std::vector<MatrixXd> fitted, checked;
    for (const auto& rung : rungs) {
      MatrixXd all(equations.torque().size(), static_cast<Index>(rung.size()));
      for (std::size_t i = 0; i < rung.size(); ++i) {
        all.col(static_cast<Index>(i)) = equations.stacked(column_of(rung[i]));
      }
      const MatrixXd own = all(equations.fitted(), Eigen::all);
      const MatrixXd taken = model.solve(own);  // by the base model
      fitted.push_back(own - base * taken);
      checked.push_back(all(equations.checked(), Eigen::all) - checked_base * taken);
    }
    const auto& rung = rungs[best_rung(fitted, left, checked, checked_left)];
    if (rung.empty()) continue;
    result.names.push_back({family_of(rung.back()), j + 1});
    for (const FrictionTerm& term : rung) chosen.push_back(column_of(term));
  }
  result.heldout_rms = equations.heldout_rms(equations.refitted(std::move(chosen)));
  return result;
}

}  // namespace

std::vector<BaselineResult> baseline_results(const EffectRecordings& train,
                                             const EffectRecordings& heldout,
                                             const std::vector<EffectInstance>& hypotheses) {
  const Equations equations(train, heldout);
  const EffectDictionary dictionary = effect_dictionary(hypotheses, train);
  return {of_effects("base", equations, dictionary, {}),
          of_effects("lasso", equations, dictionary, lasso(dictionary.set)),
          of_effects("sindy", equations, dictionary, thresholded(dictionary.set)),
          of_splines(equations, train),
          of_ladder(equations, train),
          of_effects("forward", equations, dictionary, forward(dictionary.set))};
}

}  // namespace dyngen::test
