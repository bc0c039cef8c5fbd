// SPDX-License-Identifier: MIT
#include "runtime/identification/common_cutoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/estimation/distributions.h"
#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/rows.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/standing_joints.h"
#include "runtime/signals/trim.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFolds = 10;
constexpr Index kMostEquations = 2500;     // of a joint, in a trial: enough for any robot
constexpr Index kMostFiltered = 400'000;   // samples that are filtered again for each trial
constexpr double kNoWorse = 0.05;          // of the squares of held-out torque
constexpr double kConfidence = 0.9;        // of both sides: 0.95 that a trial is worse
constexpr double kMostTrimmed = 1.0 / 16;  // of the longest run, at each of its ends

Index samples_of(const MotionSource& source) {
  Index count = 0;
  source.pieces([&](const StreamPiece& piece) { count += piece.motion.samples(); });
  return count;
}

double longest_run(const MotionSource& source) {
  double longest = 0, run = 0;
  source.pieces([&](const StreamPiece& piece) {
    if (!piece.continues_run) run = 0;
    run += static_cast<double>(piece.motion.samples()) * piece.motion.sample_time;
    longest = std::max(longest, run);
  });
  return longest;
}

/// Half of all samples have a cut-off of this source's, or a lower one.
const MotionSource& median_source(std::vector<const MotionSource*> sources) {
  std::sort(sources.begin(), sources.end(), [](const MotionSource* a, const MotionSource* b) {
    return a->cutoff.hz < b->cutoff.hz;
  });
  Index all = 0, below = 0;
  for (const MotionSource* source : sources) all += samples_of(*source);
  for (const MotionSource* source : sources) {
    below += samples_of(*source);
    if (2 * below >= all) return *source;
  }
  return *sources.back();
}

double trim_of(double hz, double sample_time) {
  return filter_trim(design_butterworth(JointStateOptions{}.order, hz, sample_time));
}

/// Equations of single samples, in blocks; which samples, the first state that is added decides.
class BlockedEquations {
 public:
  BlockedEquations(const LinearModel& model, const std::vector<MotionSource>& sources)
      : model_(model) {
    for (const MotionSource& source : sources) samples_ += samples_of(source);
    step_ = std::max<Index>(1, samples_ / kMostEquations);
    const std::vector<StandingJoints> standing = standing_joints(sources, model.revolute, sources);
    for (std::size_t i = 0; i < sources.size(); ++i) look_at_speeds(sources[i], standing[i]);
  }

  /// Of the same recordings behind a low-pass. @return  a factor for each block
  [[nodiscard]] std::vector<TorqueFactor> factors(const std::vector<MotionSource>& sources) const {
    std::vector<TorqueFactor> blocks(static_cast<std::size_t>(kFolds),
                                     empty_factor(model_.columns, model_.size()));
    Index place = 0;
    std::size_t used = 0;
    for (const MotionSource& source : sources) {
      source.pieces([&](const StreamPiece& piece) { add(piece.motion, place, used, blocks); });
    }
    return blocks;
  }

 private:
  /// Joints that stand have no say: what they give way by is noise of the drive that holds them.
  void look_at_speeds(const MotionSource& source, const StandingJoints& standing) {
    VectorXd still = plan_rows(source, {}).still_speed;
    for (std::size_t j = 0; j < standing.size(); ++j) {
      if (standing[j]) still[static_cast<Index>(j)] = std::numeric_limits<double>::infinity();
    }
    source.pieces([&](const StreamPiece& piece) {
      for (Index k = first_of(place_); k < piece.motion.samples(); k += step_) {
        moves_.push_back(
            (piece.motion.dq.row(k).transpose().cwiseAbs().array() >= still.array()).eval());
      }
      place_ += piece.motion.samples();
    });
  }

  /// The first sample that counts, of a piece that begins at that place.
  [[nodiscard]] Index first_of(Index place) const { return (step_ - place % step_) % step_; }

  void add(const Motion& motion, Index& place, std::size_t& used,
           std::vector<TorqueFactor>& blocks) const {
    std::vector<Index> rows;
    for (Index k = first_of(place); k < motion.samples(); k += step_) rows.push_back(k);
    std::size_t begin = 0;
    while (begin < rows.size()) {
      const Index block = block_of(place + rows[begin]);
      std::size_t end = begin + 1;
      while (end < rows.size() && block_of(place + rows[end]) == block) ++end;
      const std::vector<Index> own(rows.begin() + static_cast<std::ptrdiff_t>(begin),
                                   rows.begin() + static_cast<std::ptrdiff_t>(end));
      absorb(blocks[static_cast<std::size_t>(block)], equations(motion, own, used + begin));
      begin = end;
    }
    used += rows.size();
    place += motion.samples();
  }

  [[nodiscard]] Index block_of(Index place) const {
    return std::min(kFolds - 1, place * kFolds / std::max<Index>(samples_, 1));
  }

  [[nodiscard]] RowBlock equations(const Motion& motion, const std::vector<Index>& rows,
                                   std::size_t first) const {
    RowBlock block;
    model_.regressor(motion.q(rows, Eigen::all), motion.dq(rows, Eigen::all),
                     motion.ddq(rows, Eigen::all), block.Y);
    clear_rounding(block.Y, motion.joints());
    block.tau = motion.tau(rows, Eigen::all);
    block.counted = MatrixXd::Ones(block.tau.rows(), block.tau.cols());
    for (Index k = 0; k < block.tau.rows(); ++k) {
      for (Index j = 0; j < block.tau.cols(); ++j) {
        if (moves_[first + static_cast<std::size_t>(k)][j]) continue;
        block.counted(k, j) = block.tau(k, j) = 0;
        block.Y.row(k).segment(j * model_.size(), model_.size()).setZero();
      }
    }
    return block;
  }

  const LinearModel& model_;
  Index samples_ = 0, step_ = 1, place_ = 0;
  std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> moves_;  ///< of each sample that counts
};

/// What each block's torque leaves of a prediction by the others. @return (kFolds x n) squares
MatrixXd predicted_squares(const std::vector<TorqueFactor>& blocks) {
  MatrixXd squares(kFolds, static_cast<Index>(blocks.front().joints.size()));
  for (std::size_t out = 0; out < blocks.size(); ++out) {
    TorqueFactor others = empty_factor(blocks[out].columns, blocks[out].parameters);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (b != out) merge(others, blocks[b]);
    }
    const VectorXd beta = weighted_least_squares(others).beta;
    squares.row(static_cast<Index>(out)) = residual_squares(blocks[out], beta).transpose();
  }
  return squares;
}

bool enough_equations(const std::vector<TorqueFactor>& blocks) {
  TorqueFactor all = blocks.front();
  for (std::size_t b = 1; b < blocks.size(); ++b) merge(all, blocks[b]);
  return all.samples() > 4.0 * static_cast<double>(all.parameters);
}

/// Mean over blocks of the logarithm of a ratio of squares, and its standard deviation: one block
/// in which everything fails decides no more than the others.
struct MeanLogarithm {
  double mean = 0, deviation = 0;
};

MeanLogarithm compared(const VectorXd& trial, const VectorXd& other) {
  std::vector<double> logarithms;
  for (Index b = 0; b < trial.size(); ++b) {
    if (trial[b] > 0 && other[b] > 0) logarithms.push_back(std::log(trial[b] / other[b]));
  }
  const auto count = static_cast<Index>(logarithms.size());
  if (count < 2) return {};
  const Eigen::Map<const Eigen::ArrayXd> ratio(logarithms.data(), count);
  const double blocks = static_cast<double>(count), mean = ratio.mean();
  return {mean, std::sqrt((ratio - mean).square().sum() / (blocks - 1) / blocks)};
}

/// Whether a trial is worse than the best one, block by block. Both: (kFolds)
bool is_worse(const VectorXd& trial, const VectorXd& best) {
  const MeanLogarithm ratio = compared(trial, best);
  if (ratio.mean <= std::log1p(kNoWorse)) return false;
  return ratio.mean >
         student_interval(kConfidence, static_cast<double>(kFolds - 1)) * ratio.deviation;
}

struct Trial {
  double hz = 0;
  MatrixXd squares;  ///< (kFolds x n)
  VectorXd sum;      ///< (kFolds) over joints, each divided by the least of any trial
};

void add_up(std::vector<Trial>& trials) {
  VectorXd least = trials.front().squares.colwise().sum().transpose();
  for (const Trial& trial : trials) {
    least = least.cwiseMin(trial.squares.colwise().sum().transpose());
  }
  const VectorXd weights =
      least.unaryExpr([](double squares) { return squares > 0 ? 1 / squares : 0; });
  for (Trial& trial : trials) trial.sum = trial.squares * weights;
}

/// Half octaves around the first choice, within what any choice may be.
std::vector<double> trial_frequencies(double first, double sample_time, double longest) {
  std::vector<double> all = {first};
  const auto allowed = [&](double hz) {
    return hz >= kLowestCutoff && hz <= kHighestCutoff / sample_time * (1 + 1e-9) &&
           trim_of(hz, sample_time) < kMostTrimmed * longest;
  };
  const double half_octave = std::sqrt(2.0);
  for (double hz = first / half_octave; allowed(hz); hz /= half_octave) all.push_back(hz);
  for (double hz = first * half_octave; allowed(hz); hz *= half_octave) all.push_back(hz);
  return all;
}

/// Those whose cut-off is open.
std::vector<const MotionSource*> open_sources(const std::vector<MotionSource>& sources) {
  std::vector<const MotionSource*> open;
  for (const MotionSource& source : sources) {
    if (source.others.at && source.cutoff.hz > 0) open.push_back(&source);
  }
  return open;
}

/// The first of them, and more while they have no more samples than are filtered for each trial.
std::vector<const MotionSource*> few_samples(const std::vector<const MotionSource*>& sources) {
  std::vector<const MotionSource*> few;
  Index samples = 0;
  for (const MotionSource* source : sources) {
    samples += samples_of(*source);
    if (!few.empty() && samples > kMostFiltered) break;
    few.push_back(source);
  }
  return few;
}

std::vector<MotionSource> behind(const std::vector<const MotionSource*>& sources, double hz,
                                 double trim) {
  std::vector<MotionSource> all;
  for (const MotionSource* source : sources) {
    all.push_back(source->others.at(Cutoff{hz, ""}, trim));
  }
  return all;
}

/// The first, if it is no worse than the best.
const Trial& taken(const std::vector<Trial>& trials) {
  const Trial* best = &trials.front();
  for (const Trial& trial : trials) {
    if (compared(trial.sum, best->sum).mean < 0) best = &trial;
  }
  return is_worse(trials.front().sum, best->sum) ? *best : trials.front();
}

std::string words_of(const Trial& chosen, const Trial& first, std::size_t recordings) {
  const std::string whose = recordings > 1 ? " for all recordings" : "";
  const double ratio = std::exp(0.5 * compared(first.sum, chosen.sum).mean);
  return fmt::format(
      "cut-off {:.3g} Hz{}: torque of blocks that are left out is predicted {:.3g} times as well "
      "as behind {:.3g} Hz, up to which accelerations are above their noise",
      chosen.hz, whose, ratio, first.hz);
}

}  // namespace

Cutoff median_cutoff(const std::vector<MotionSource>& sources) {
  const std::vector<const MotionSource*> open = open_sources(sources);
  if (open.empty()) return {};
  Cutoff cutoff = median_source(open).cutoff;
  if (open.size() > 1) cutoff.message += ", for all recordings";
  return cutoff;
}

Cutoff common_cutoff(const LinearModel& model, const std::vector<MotionSource>& sources) {
  Cutoff first = median_cutoff(sources);
  const bool fit = std::all_of(sources.begin(), sources.end(), [&](const MotionSource& source) {
    return source.joints() == model.joints();
  });
  if (first.hz == 0 || !fit) return first;
  std::vector<const MotionSource*> filtered = few_samples(open_sources(sources));
  const double sample_time = filtered.front()->sample_time;
  double longest = 0;
  for (const MotionSource* source : filtered) longest = std::max(longest, longest_run(*source));
  const std::vector<double> frequencies = trial_frequencies(first.hz, sample_time, longest);
  const double trim =
      trim_of(*std::min_element(frequencies.begin(), frequencies.end()), sample_time);
  // what is left of them could not be trimmed
  std::erase_if(filtered,
                [&](const MotionSource* source) { return longest_run(*source) < 3 * trim; });
  std::vector<Trial> trials;
  const BlockedEquations equations(model, behind(filtered, first.hz, trim));
  for (const double hz : frequencies) {
    const std::vector<TorqueFactor> blocks = equations.factors(behind(filtered, hz, trim));
    if (!enough_equations(blocks)) return first;
    trials.push_back({hz, predicted_squares(blocks), {}});
  }
  add_up(trials);
  const Trial& chosen = taken(trials);
  if (&chosen == &trials.front()) return first;
  return {chosen.hz, words_of(chosen, trials.front(), sources.size())};
}

std::vector<MotionSource> at_cutoff(const std::vector<MotionSource>& sources,
                                    const Cutoff& cutoff) {
  std::vector<MotionSource> all;
  for (const MotionSource& source : sources) {
    const bool other = source.others.at && cutoff.hz > 0 && source.cutoff.hz != cutoff.hz;
    all.push_back(other ? source.others.at(cutoff, -1) : source);
    all.back().name = source.name;
    all.back().recorded = source.recorded;
  }
  return all;
}

}  // namespace dyngen::runtime
