// SPDX-License-Identifier: MIT
#include "runtime/steady/steady_levels.h"

#include <algorithm>
#include <cmath>

#include "runtime/estimation/robust_regression.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A run with its samples, about their means.
struct RunSamples {
  VectorXd torque;   ///< (count)
  MatrixXd gravity;  ///< (count x 2) cos q, sin q; no columns where none are needed
  Eigen::RowVectorXd mean_gravity;
};

RunSamples samples_of(const SteadyInput& input, const SteadyRun& run, double& mean) {
  const Stretch& own = run.stretch;
  const Recording& recording = *input.recordings[static_cast<std::size_t>(own.recording)];
  RunSamples samples;
  samples.torque = recording.tau.col(input.joint).segment(own.first, own.count);
  if (!run.alone) samples.torque -= input.rest(own);
  samples.gravity.resize(own.count, run.alone && input.revolute ? 2 : 0);
  if (samples.gravity.cols() == 2) {
    const auto q = recording.q.col(input.joint).segment(own.first, own.count).array();
    samples.gravity.col(0) = q.cos();
    samples.gravity.col(1) = q.sin();
  }
  mean = samples.torque.mean();
  samples.torque.array() -= mean;
  samples.mean_gravity = samples.gravity.colwise().mean();
  samples.gravity.rowwise() -= samples.mean_gravity;
  return samples;
}

/// The posture of the other joints that a run belongs to; one that is new is added.
int posture_of(const SteadyRun& run, Index joint, const SteadyRules& rules,
               std::vector<VectorXd>& postures) {
  VectorXd others = run.posture;
  others[joint] = 0;
  if (!run.alone) others.setConstant(0);
  for (std::size_t p = 0; p < postures.size(); ++p) {
    const bool moving = postures[p].size() == 0;
    if (moving != !run.alone) continue;
    if (moving || (postures[p] - others).cwiseAbs().maxCoeff() <= rules.same_posture) {
      return static_cast<int>(p);
    }
  }
  postures.push_back(run.alone ? others : VectorXd());
  return static_cast<int>(postures.size()) - 1;
}

/// Takes gravity out of the runs of one posture, and adds what its error does to their means.
void take_gravity(const std::vector<std::size_t>& runs, std::vector<RunSamples>& samples,
                  SteadyLevels& result) {
  Index rows = 0;
  for (const std::size_t r : runs) rows += samples[r].torque.size();
  if (rows == 0 || samples[runs.front()].gravity.cols() == 0) return;
  MatrixXd D(rows, 2);
  VectorXd w(rows);
  Index row = 0;
  double seconds = 0;
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(2);
  for (const std::size_t r : runs) {
    const Index count = samples[r].torque.size();
    D.middleRows(row, count) = samples[r].gravity;
    w.segment(row, count) = samples[r].torque;
    row += count;
    seconds += result.levels[r].run.stretch.seconds();
    mean += samples[r].mean_gravity / static_cast<double>(runs.size());
  }
  constexpr double kRows = 2;  // independent ones a second
  const RobustRegression fit = robust_regression(D, w, cosines_for(kRows * seconds));
  MatrixXd apart(static_cast<Index>(runs.size()), 2);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t r = runs[i];
    apart.row(static_cast<Index>(i)) = samples[r].mean_gravity - mean;
    samples[r].torque -= samples[r].gravity * fit.beta;
    result.levels[r].torque -= apart.row(static_cast<Index>(i)).dot(fit.beta);
  }
  const MatrixXd added = apart * fit.covariance * apart.transpose();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      result.covariance(static_cast<Index>(runs[i]), static_cast<Index>(runs[k])) +=
          added(static_cast<Index>(i), static_cast<Index>(k));
    }
  }
}

}  // namespace

SteadyLevels steady_levels(const SteadyInput& input, const SteadyRules& rules) {
  SteadyLevels result;
  std::vector<RunSamples> samples;
  std::vector<VectorXd> postures;
  for (std::size_t i = 0; i < input.recordings.size(); ++i) {
    for (SteadyRun& run : find_steady_runs(*input.recordings[i], input.joint, rules)) {
      run.stretch.recording = static_cast<int>(i);
      if (!run.alone && !input.rest) {
        ++result.left_out;
        continue;
      }
      double mean = 0;
      samples.push_back(samples_of(input, run, mean));
      const int posture = posture_of(run, input.joint, rules, postures);
      result.seconds += run.stretch.seconds();
      result.levels.push_back({std::move(run), mean, posture});
    }
  }
  result.postures = static_cast<int>(postures.size());
  if (result.levels.empty()) return result;
  const auto count = static_cast<Index>(result.levels.size());
  result.covariance = MatrixXd::Zero(count, count);
  for (int p = 0; p < result.postures; ++p) {
    std::vector<std::size_t> own;
    for (std::size_t r = 0; r < result.levels.size(); ++r) {
      if (result.levels[r].posture == p) own.push_back(r);
    }
    take_gravity(own, samples, result);
  }
  std::vector<CosinePowers> powers;
  std::vector<Stretch> stretches;
  for (std::size_t r = 0; r < result.levels.size(); ++r) {
    stretches.push_back(result.levels[r].run.stretch);
    powers.push_back(cosine_powers(stretches.back(), samples[r].torque, rules));
  }
  const MeanNoise noise = fit_mean_noise(powers, rules);
  result.covariance += covariance_of_means(noise, stretches);
  result.degrees = noise.degrees;
  return result;
}

}  // namespace dyngen::runtime
