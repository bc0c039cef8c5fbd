// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/repeated_motion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "runtime/diagnosis/equation_sets/same_motions.h"
#include "runtime/effects/effect_fit.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kRefits = 4;  // of the model's own parameters

/// The mean over all rows of the same phase but the own.
MatrixXd of_the_others(const MatrixXd& rows, Index period) {
  MatrixXd sum = MatrixXd::Zero(period, rows.cols());
  for (Index k = 0; k < rows.rows(); ++k) sum.row(k % period) += rows.row(k);
  MatrixXd mean(rows.rows(), rows.cols());
  for (Index k = 0; k < rows.rows(); ++k) {
    const Index phase = k % period;
    const Index count = (rows.rows() - phase + period - 1) / period;
    mean.row(k) = (sum.row(phase) - rows.row(k)) / static_cast<double>(count - 1);
  }
  return mean;
}

/// Samples after which a motion repeats, often enough and in whole samples; 0: it does not.
Index period_of(const Motion& run, const EquationRules& rules) {
  const double length = run.period / run.sample_time, samples = std::round(length);
  if (!(samples > 0)) return 0;
  const double count = std::floor(static_cast<double>(run.samples()) / samples);
  return count < rules.fewest_periods || std::abs(length - samples) * count > rules.period_mismatch
             ? 0
             : static_cast<Index>(samples);
}

Motion repeated(Motion run, const EquationRules& rules) {
  const Index period = period_of(run, rules);
  if (period == 0) return run;
  for (MatrixXd* rows : {&run.q, &run.dq, &run.ddq}) *rows = of_the_others(*rows, period);
  return run;
}

/// @param repeated  as it was made  @param left  gets its torque
void leave_as_at(const RowBlock& repeated, const RowBlock& own, const Eigen::VectorXd& beta,
                 RowBlock& left) {
  for (Index j = 0; j < own.tau.cols(); ++j) {
    const auto Y = [&](const RowBlock& rows) {
      return rows.Y.middleCols(j * beta.size(), beta.size());
    };
    const Eigen::VectorXd both = repeated.counted.col(j).cwiseProduct(own.counted.col(j));
    left.counted.col(j) = both;
    left.tau.col(j) = both.cwiseProduct(own.tau.col(j) + (Y(repeated) - Y(own)) * beta);
    left.Y.middleCols(j * beta.size(), beta.size()) = both.asDiagonal() * Y(repeated);
  }
}

void append(Motion& run, const Motion& piece) {
  const Index before = run.samples(), more = piece.samples();
  const auto grow = [&](auto& to, const auto& from) {
    if (from.rows() == 0) return;
    to.conservativeResize(before + more, from.cols());
    to.bottomRows(more) = from;
  };
  grow(run.time, piece.time);
  grow(run.q, piece.q);
  grow(run.dq, piece.dq);
  grow(run.ddq, piece.ddq);
  grow(run.tau, piece.tau);
  grow(run.temperature, piece.temperature);
}

std::vector<Motion> whole_runs(const MotionSource& source) {
  std::vector<Motion> runs;
  source.pieces([&](const StreamPiece& piece) {
    if (piece.continues_run && !runs.empty()) {
      append(runs.back(), piece.motion);
    } else {
      runs.push_back(piece.motion);
    }
  });
  return runs;
}

}  // namespace

MotionSource with_repeated_motion(const MotionSource& source, const EquationRules& rules) {
  return with_pieces(source, [source, rules](const std::function<void(const StreamPiece&)>& visit) {
    for (Motion& run : whole_runs(source)) visit({repeated(std::move(run), rules), false});
  });
}

bool repeats(const MotionSource& source, const EquationRules& rules) {
  const std::vector<Motion> runs = whole_runs(source);
  return std::any_of(runs.begin(), runs.end(),
                     [&](const Motion& run) { return period_of(run, rules) > 0; });
}

TwoMotions two_motions(const MotionSource& source, const EquationRules& rules) {
  if (repeats(source, rules)) return {source, with_repeated_motion(source, rules)};
  if (!source.others.parities) return {source, source};
  return {source.others.make({.parity = 1}), source.others.make({.parity = 0})};
}

std::vector<TwoMotions> two_motions(const std::vector<MotionSource>& sources,
                                    const EquationRules& rules) {
  std::vector<TwoMotions> all;
  std::vector<Motion> runs;
  std::vector<std::size_t> first;  // of each source among the runs
  for (const MotionSource& source : sources) {
    first.push_back(runs.size());
    for (Motion& run : whole_runs(source)) runs.push_back(std::move(run));
  }
  first.push_back(runs.size());
  std::vector<const Motion*> motions;
  for (const Motion& run : runs) motions.push_back(&run);
  std::vector<std::optional<Motion>> means = of_same_motions(motions, rules);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    auto pieces = std::make_shared<std::vector<StreamPiece>>();
    bool same = false;
    for (std::size_t run = first[i]; run < first[i + 1]; ++run) {
      same = same || means[run].has_value();
      pieces->push_back({means[run] ? std::move(*means[run]) : std::move(runs[run]), false});
    }
    if (!same) {
      all.push_back(two_motions(sources[i], rules));
      continue;
    }
    all.push_back({sources[i], with_pieces(sources[i], [pieces](const auto& visit) {
                     for (const StreamPiece& piece : *pieces) visit(piece);
                   })});
  }
  return all;
}

Eigen::VectorXd leave_as_at(EffectRecordings& repeated, const EffectRecordings& own) {
  Eigen::VectorXd beta = fit_effects(own, {}).point.beta;
  const EffectRecordings recorded = repeated;
  for (int round = 0; round < kRefits; ++round) {
    if (round > 0) beta = fit_effects(repeated, {}).point.beta;
    repeated = recorded;
    leave_as_at(repeated, own, beta);
  }
  return beta;
}

void leave_as_at(EffectRecordings& repeated, const EffectRecordings& own,
                 const Eigen::VectorXd& beta) {
  for (std::size_t run = 0; run < own.runs.size(); ++run) {
    const RowBlock recorded = repeated.runs[run].rows;
    leave_as_at(recorded, own.runs[run].rows, beta, repeated.runs[run].rows);
  }
}

}  // namespace dyngen::runtime
