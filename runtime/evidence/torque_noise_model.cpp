// SPDX-License-Identifier: MIT
#include "runtime/evidence/torque_noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "runtime/effects/effect_rows.h"
#include "runtime/effects/equation_stack.h"
#include "runtime/evidence/lag_products.h"
#include "runtime/evidence/period_differences.h"
#include "runtime/evidence/slow_noise.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> repeats_of(const EffectRecordings& data) {
  std::vector<double> repeats;
  for (const EffectRun& run : data.runs) {
    const double row_time = run.motion.sample_time * static_cast<double>(run.decimator.factor);
    repeats.push_back(run.motion.period / row_time);
  }
  return repeats;
}

namespace {

constexpr int kRounds = 3;  // of the search for the noise before the fit
constexpr int kDraws = 8;   // of simulated noise in each
constexpr unsigned kNoiseSeed = 20261121;

using OfJoints = std::vector<LagProducts>;

OfJoints lag_products(const EffectRecordings& data, const RunResiduals& residuals) {
  OfJoints products(static_cast<std::size_t>(data.joints()));
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    for (int j = 0; j < data.joints(); ++j) {
      products[static_cast<std::size_t>(j)].add(residuals[run].col(j),
                                                data.runs[run].rows.counted.col(j));
    }
  }
  return products;
}

/// Noise of all joints, 0 where equations do not count.
RunResiduals simulated(const EffectRecordings& data, const std::vector<AutoregressiveNoise>& joints,
                       std::mt19937_64& random) {
  constexpr Index kRunIn = 200;
  std::normal_distribution<double> normal;
  RunResiduals noise;
  for (const EffectRun& run : data.runs) {
    const Index rows = run.rows.Y.rows();
    noise.emplace_back(rows, data.joints());
    for (Index j = 0; j < data.joints(); ++j) {
      const AutoregressiveNoise& process = joints[static_cast<std::size_t>(j)];
      const Index order = process.coefficients.size();
      VectorXd x = VectorXd::Zero(kRunIn + rows);
      for (Index t = 0; t < x.size(); ++t) {
        x[t] = process.innovation * normal(random);
        for (Index k = 0; k < std::min(order, t); ++k)
          x[t] += process.coefficients[k] * x[t - 1 - k];
      }
      noise.back().col(j) = x.tail(rows).cwiseProduct(run.rows.counted.col(j));
    }
  }
  return noise;
}

/// What a fit of the model takes of residuals, joints weighted by their noise.
class FittedPart {
 public:
  /// @param largest  columns beside the model, by joint; may be empty
  FittedPart(const EffectRecordings& data, const std::vector<AutoregressiveNoise>& joints,
             const std::vector<JointColumns>& largest)
      : weights_(data.joints()) {
    for (Index j = 0; j < weights_.size(); ++j) {
      weights_[j] = 1 / joints[static_cast<std::size_t>(j)].deviation;
    }
    const Index size = data.model.size();
    Index columns = size;
    for (const JointColumns& own : largest) columns += own.columns();
    MatrixXd W = MatrixXd::Zero(data.equations() * data.joints(), columns);
    Index start = 0, first = 0;  // of a run's rows in all, and in those of one joint
    for (const EffectRun& run : data.runs) {
      Index column = size;
      for (const JointColumns& own : largest) {
        const Index j = own.joints.front(), rows = run.rows.Y.rows();
        W.block(start + j * rows, column, rows, own.columns()) =
            weights_[j] * own.parts.front().middleRows(first, rows);
        column += own.columns();
      }
      first += run.rows.Y.rows();
      for (Index j = 0; j < data.joints(); ++j) {
        for (const int c : data.model.columns[static_cast<std::size_t>(j)]) {
          W.col(c).segment(start, run.rows.Y.rows()) =
              weights_[j] * run.rows.Y.col(j * size + c).cwiseProduct(run.rows.counted.col(j));
        }
        start += run.rows.Y.rows();
      }
    }
    basis_ = orthonormal(W);
  }

  void take_out_of(RunResiduals& residuals) const {
    VectorXd all(basis_.rows());
    each(residuals,
         [&](auto part, double weight, Index at) { all.segment(at, part.size()) = weight * part; });
    all -= basis_ * (basis_.transpose() * all);
    each(residuals,
         [&](auto part, double weight, Index at) { part = all.segment(at, part.size()) / weight; });
  }

 private:
  template <class Visit>
  void each(RunResiduals& residuals, const Visit& visit) const {
    Index at = 0;
    for (MatrixXd& run : residuals) {
      for (Index j = 0; j < run.cols(); ++j) {
        visit(run.col(j), weights_[j], at);
        at += run.rows();
      }
    }
  }

  VectorXd weights_;
  MatrixXd basis_;
};

/// Processes whose noise, behind a fit, has the autocovariances that were observed.
std::vector<AutoregressiveNoise> before_the_fit(const EffectRecordings& data,
                                                const OfJoints& observed,
                                                std::vector<AutoregressiveNoise> joints,
                                                const std::vector<JointColumns>& largest) {
  const FittedPart fit(data, joints, largest);
  std::vector<VectorXd> left;  // autocovariances
  for (const LagProducts& joint : observed) left.push_back(joint.covariance());
  std::mt19937_64 random(kNoiseSeed);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<VectorXd> taken(joints.size(), VectorXd::Zero(kNoiseLags + 1));
    for (int draw = 0; draw < kDraws; ++draw) {
      RunResiduals noise = simulated(data, joints, random);
      const OfJoints before = lag_products(data, noise);
      fit.take_out_of(noise);
      const OfJoints after = lag_products(data, noise);
      for (std::size_t j = 0; j < joints.size(); ++j) {
        taken[j] += (before[j].of_pairs() - after[j].of_pairs()) / kDraws;
      }
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double samples = std::max(1.0, observed[j].samples());
      joints[j] = fit_autoregression(left[j] + taken[j], samples);
    }
  }
  return joints;
}

/// Whether a joint has equations.
std::vector<bool> joints_with_equations(const OfJoints& products) {
  std::vector<bool> has;
  for (const LagProducts& joint : products) has.push_back(joint.samples() > 0);
  return has;
}

AutoregressiveNoise unit_noise() {
  AutoregressiveNoise white;
  white.innovation = white.deviation = 1;
  return white;
}

/// Noise of all joints. @param seen  of those that have equations
std::vector<JointNoise> of_all(std::vector<JointNoise> seen, const std::vector<bool>& has) {
  std::vector<JointNoise> joints;
  auto next = seen.begin();
  for (const bool own : has) joints.push_back(own ? *next++ : JointNoise{unit_noise(), {}});
  return joints;
}

/// A joint without equations has white noise of unit variance, which no equation meets, and is
/// worth no sample.
void settle_unseen(const std::vector<bool>& has, TorqueNoiseModel& model) {
  for (std::size_t j = 0; j < has.size(); ++j) {
    if (has[j]) continue;
    model.joints[j] = {unit_noise(), {}};
    model.correlation_time[static_cast<Index>(j)] = 1;
    model.worth[static_cast<Index>(j)] = 0;
  }
}

/// Least of the joints that have equations.
double least_worth(const VectorXd& worth, const std::vector<bool>& has) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < has.size(); ++j) {
    if (has[j]) least = std::min(least, worth[static_cast<Index>(j)]);
  }
  return least;
}

std::vector<AutoregressiveNoise> processes_of(const OfJoints& all) {
  std::vector<AutoregressiveNoise> joints;
  for (const LagProducts& products : all) {
    joints.push_back(products.samples() > 0
                         ? fit_autoregression(products.covariance(), products.samples())
                         : unit_noise());
  }
  return joints;
}

/// @throws std::invalid_argument  if a joint has none
void refuse_no_noise(const std::vector<JointNoise>& joints) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].quick.innovation > 0) continue;
    throw std::invalid_argument(
        fmt::format("the model explains the torque of joint {} exactly: there is no noise to "
                    "judge by; expected a recording of a real measurement",
                    j + 1));
  }
}

/// How well noise is known.
/// @param samples    of each joint that it was found from
/// @param frequency  cycles for a sample: that of the motion; 0: none repeats
void know_by(TorqueNoiseModel& model, const std::vector<double>& samples, double frequency) {
  model.worth.resize(static_cast<Index>(samples.size()));
  model.correlation_time.resize(model.worth.size());
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const JointNoise& noise = model.joints[j];
    const double time = noise.density(frequency) / std::pow(noise.deviation(), 2);
    model.correlation_time[static_cast<Index>(j)] = time;
    model.worth[static_cast<Index>(j)] = samples[j] / std::max(1.0, time);
  }
}

/// Differences of one joint between neighbouring periods of each run.
void add_periods(const EffectRecordings& data, const RunResiduals& residuals,
                 const std::vector<double>& repeats, Index joint, PeriodDifferences& differences) {
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    if (!(repeats[run] > 0)) continue;
    differences.add(residuals[run].col(joint), data.runs[run].rows.counted.col(joint),
                    repeats[run]);
  }
}

/// Between neighbouring recordings of one motion.
void add_recordings(const EffectRecordings& data, const RunResiduals& residuals, Index joint,
                    PeriodDifferences& differences) {
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& later = data.runs[run];
    if (!later.earlier) continue;
    const EffectRun& earlier = data.runs[later.earlier->run];
    if (earlier.decimator.factor != later.decimator.factor) continue;
    const VectorXd before = residuals[later.earlier->run].col(joint),
                   now = residuals[run].col(joint);
    const VectorXd counted_before = earlier.rows.counted.col(joint),
                   counted_now = later.rows.counted.col(joint);
    differences.add_between({before, counted_before}, {now, counted_now},
                            later.earlier->lag / (later.motion.sample_time *
                                                  static_cast<double>(later.decimator.factor)));
  }
}

/// Mean of those that repeat; 0 if none does.
double mean_period(const std::vector<double>& repeats) {
  double sum = 0, count = 0;
  for (const double period : repeats) {
    if (!(period > 0)) continue;
    sum += period;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

KnownNoise TorqueNoiseModel::known() const {
  KnownNoise noise;
  for (const JointNoise& joint : joints) noise.parts.push_back(joint.parts());
  noise.correlation_time = correlation_time;
  return noise;
}

TorqueNoiseModel torque_noise_model(const EffectRecordings& data, const RunResiduals& residuals,
                                    const std::vector<double>& repeats, bool fitted,
                                    const NoiseRules& rules,
                                    const std::vector<JointColumns>& largest) {
  TorqueNoiseModel model;
  const OfJoints all = lag_products(data, residuals);
  std::vector<PeriodDifferences> repeated(all.size(), PeriodDifferences(rules));
  model.of_recordings =
      std::none_of(repeats.begin(), repeats.end(), [](double p) { return p > 0; });
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (model.of_recordings) {
      add_recordings(data, residuals, static_cast<Index>(j), repeated[j]);
    } else {
      add_periods(data, residuals, repeats, static_cast<Index>(j), repeated[j]);
    }
  }
  const std::vector<bool> has = joints_with_equations(all);
  std::vector<double> differences, samples;
  std::vector<PeriodDifferences> seen;
  double fewest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < all.size(); ++j) {
    differences.push_back(repeated[j].samples());
    samples.push_back(all[j].samples());
    if (!has[j]) continue;
    fewest = std::min(fewest, repeated[j].samples());
    seen.push_back(repeated[j]);
  }
  const double period =
      model.of_recordings ? std::numeric_limits<double>::infinity() : mean_period(repeats);
  if (period > 0 && !seen.empty() && fewest >= rules.least_independent) {
    double longest = 0;
    for (const EffectRun& run : data.runs) {
      longest = std::max(longest, static_cast<double>(run.rows.Y.rows()));
    }
    model.joints = of_all(noise_of_periods(seen, {period, longest}, rules), has);
    know_by(model, differences, 1 / period);
    settle_unseen(has, model);
    model.from_periods = least_worth(model.worth, has) >= rules.least_independent;
  }
  model.of_recordings = model.of_recordings && model.from_periods;
  if (!model.from_periods) {
    std::vector<AutoregressiveNoise> joints = processes_of(all);
    refuse_no_noise(quick_noise(joints));
    if (largest.empty()) {
      if (fitted) joints = before_the_fit(data, all, std::move(joints), largest);
    } else {
      RunResiduals left = residuals;
      FittedPart(data, joints, largest).take_out_of(left);
      const OfJoints beside = lag_products(data, left);
      joints = before_the_fit(data, beside, processes_of(beside), largest);
      for (const JointColumns& own : largest) {
        samples[static_cast<std::size_t>(own.joints.front())] -= static_cast<double>(own.columns());
      }
      model.beside_largest = true;
    }
    model.joints = quick_noise(joints);
    know_by(model, samples, 0);
    settle_unseen(has, model);
  }
  refuse_no_noise(model.joints);
  return model;
}

}  // namespace dyngen::runtime
