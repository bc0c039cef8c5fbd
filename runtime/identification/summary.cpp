// SPDX-License-Identifier: MIT
#include "runtime/identification/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/least_squares.h"

namespace dyngen::runtime {
namespace {

void check_same(const std::vector<std::string>& mine, const std::vector<std::string>& theirs,
                const char* what) {
  for (std::size_t i = 0; i < std::max(mine.size(), theirs.size()); ++i) {
    const std::string a = i < mine.size() ? mine[i] : "nothing";
    const std::string b = i < theirs.size() ? theirs[i] : "nothing";
    if (a == b) continue;
    throw std::invalid_argument(
        fmt::format("{} {} is {} in one and {} in the other", what, i + 1, a, b));
  }
}

/// Postures spread evenly over a recording whose length is not known beforehand: every other one
/// goes whenever there are too many.
class PostureSample {
 public:
  void add(const Eigen::MatrixXd& q) {
    for (Eigen::Index i = 0; i < q.rows(); ++i, ++place_) {
      if (place_ % step_ != 0) continue;
      if (count_ == kMost) thin(q.cols());
      if (place_ % step_ != 0) continue;
      if (kept_.rows() == 0) kept_.resize(kMost, q.cols());
      kept_.row(count_++) = q.row(i);
    }
  }
  [[nodiscard]] Eigen::MatrixXd postures() const { return kept_.topRows(count_); }

 private:
  static constexpr Eigen::Index kMost = 4000;

  void thin(Eigen::Index joints) {
    count_ = kMost / 2;
    kept_.topRows(count_) =
        Eigen::MatrixXd(kept_(Eigen::seqN(0, count_, 2), Eigen::seqN(0, joints)));
    step_ *= 2;
  }

  Eigen::MatrixXd kept_;
  Eigen::Index count_ = 0, place_ = 0, step_ = 1;
};

}  // namespace

RecordingSummary empty_summary(const std::vector<std::vector<int>>& columns, int parameters) {
  RecordingSummary summary;
  summary.equations = summary.regressor_noise = empty_factor(columns, parameters);
  summary.noise = empty_noise(columns);
  return summary;
}

void merge(RecordingSummary& summary, const RecordingSummary& other) {
  if (other.recordings == 0) return;
  if (summary.recordings == 0) {
    summary.lowest_cutoff = other.lowest_cutoff;
    summary.highest_cutoff = other.highest_cutoff;
  }
  // these add up, as equations.samples(), the most of any joint, does not
  const double mine = summary.instants(), theirs = other.instants();
  summary.row_time =
      (summary.row_time * mine + other.row_time * theirs) / std::max(mine + theirs, 1.0);
  merge(summary.equations, other.equations);
  merge(summary.noise, other.noise);
  merge(summary.regressor_noise, other.regressor_noise);
  summary.extent.merge(other.extent);
  summary.lowest_cutoff = std::min(summary.lowest_cutoff, other.lowest_cutoff);
  summary.highest_cutoff = std::max(summary.highest_cutoff, other.highest_cutoff);
  summary.recordings += other.recordings;
}

NoiseFactor noise_at(const Estimate& estimate, const TorqueFactor& equations,
                     const RowSource& rows) {
  NoiseFactor noise = noise_factor(rows, equations.columns, estimate.beta);
  give_back_fitted_noise(noise, equations, estimate.joint_weights, estimate.scale, estimate.unseen);
  return noise;
}

RecordingSummary summarise_without_noise(const LinearModel& model, const MotionSource& source,
                                         const RowOptions& options) {
  RecordingSummary summary = empty_summary(model.columns, model.size());
  PostureSample postures;
  const auto watch = [&](const std::function<void(const StreamPiece&)>& visit) {
    source.pieces([&](const StreamPiece& piece) {
      summary.extent.add(piece.motion.q, piece.motion.dq, piece.motion.ddq);
      postures.add(piece.motion.q);
      visit(piece);
    });
  };
  const MotionSource watched = with_pieces(source, watch);
  const RowPlan plan = plan_rows(source, options);
  summary.equations = factor_of(rows_of(model, watched, options), model.columns, model.size());
  summary.regressor_noise =
      regressor_noise(model, postures.postures(), plan,
                      summary.extent.samples / static_cast<double>(plan.decimation));
  summary.row_time = plan.row_time;
  summary.lowest_cutoff = summary.highest_cutoff = source.cutoff.hz;
  summary.recordings = 1;
  return summary;
}

RecordingSummary summarise(const LinearModel& model, const MotionSource& source,
                           const RowOptions& options, const Eigen::VectorXd& beta) {
  RecordingSummary summary = summarise_without_noise(model, source, options);
  Estimate fit = weighted_least_squares(summary.equations);
  if (beta.size() != 0) fit.beta = beta;
  summary.noise = noise_at(fit, summary.equations, rows_of(model, source, options));
  return summary;
}

RobotSummaries empty_summaries(const LinearModel& model) {
  RobotSummaries all;
  all.model = model.name;
  all.joints = model.joint_names;
  for (const LinearParameter& parameter : model.parameters) {
    all.parameters.push_back(parameter.name);
  }
  return all;
}

void merge(RobotSummaries& all, const RobotSummaries& other) {
  check_same(all.joints, other.joints, "joint");
  check_same(all.parameters, other.parameters, "parameter");
  for (const auto& [name, summary] : other.robots) {
    const auto [place, added] = all.robots.try_emplace(name, summary);
    if (!added) merge(place->second, summary);
  }
}

RecordingSummary pooled(const RobotSummaries& all) {
  if (all.robots.empty()) throw std::invalid_argument("pooled(): there is no robot in it");
  RecordingSummary sum = all.robots.begin()->second;
  for (auto it = std::next(all.robots.begin()); it != all.robots.end(); ++it) {
    merge(sum, it->second);
  }
  return sum;
}

}  // namespace dyngen::runtime
