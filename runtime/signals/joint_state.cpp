// SPDX-License-Identifier: MIT
#include "runtime/signals/joint_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/signals/differences.h"
#include "runtime/signals/kalman_filter.h"
#include "runtime/signals/low_pass_state.h"
#include "runtime/signals/spectral.h"
#include "runtime/signals/standing.h"
#include "runtime/signals/trim.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr double kUniform = 0.01;  // of a period: how far a sample may be off

/// Rows of a run.
struct Rows {
  Index begin, count;
};

std::vector<Rows> rows_of_runs(const Recording& recording) {
  std::vector<Index> starts = recording.run_starts;
  if (starts.empty() && recording.samples() > 0) starts = {0};
  std::vector<Rows> result;
  for (std::size_t r = 0; r < starts.size(); ++r) {
    const Index end = r + 1 < starts.size() ? starts[r + 1] : recording.samples();
    if (starts[r] < 0 || end < starts[r] || end > recording.samples()) {
      throw std::invalid_argument(
          fmt::format("joint_states(): run {} has the rows {}..{}, the recording has {}", r + 1,
                      starts[r], end, recording.samples()));
    }
    result.push_back({starts[r], end - starts[r]});
  }
  return result;
}

void check_shapes(const Recording& recording) {
  const Index N = recording.samples(), n = recording.q.cols();
  const auto check = [&](const char* name, const Eigen::MatrixXd& matrix, bool optional) {
    if (optional && matrix.size() == 0) return;
    if (matrix.rows() != N || matrix.cols() != n) {
      throw std::invalid_argument(fmt::format("joint_states(): {} is {} x {}, expected {} x {}",
                                              name, matrix.rows(), matrix.cols(), N, n));
    }
  };
  check("q", recording.q, false);
  check("tau", recording.tau, true);
  check("dq", recording.dq, true);
  check("ddq", recording.ddq, true);
}

double uniform_sample_time(const Eigen::VectorXd& time, std::size_t run) {
  const double T = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  for (Index k = 0; k < time.size(); ++k) {
    const double off = time[k] - time[0] - T * static_cast<double>(k);
    if (!(T > 0) || !(std::abs(off) <= kUniform * T)) {
      throw std::invalid_argument(
          fmt::format("joint_states(): run {} is not uniformly sampled: sample {} is {:.3g} s off, "
                      "the period is "
                      "{:.3g} s; resample it first",
                      run + 1, k, off, T));
    }
  }
  return T;
}

/// Each method fills q, dq and ddq of a motion and returns the seconds that its ends deserve.
struct Filled {
  double trim = 0;
  std::vector<std::string> messages;
};

Filled fill_low_pass(Motion& motion, const JointStateOptions& options, double cutoff_hz) {
  const LowPass filter = design_butterworth(options.order, cutoff_hz, motion.sample_time);
  LowPassStates states = low_pass_states(filter, motion.q);
  motion.q = std::move(states.q);
  motion.dq = std::move(states.dq);
  motion.ddq = std::move(states.ddq);
  return {filter_trim(filter), {}};
}

Filled fill_spectral(Motion& motion, double cutoff_hz) {
  Filled filled;
  const Index N = motion.q.rows();
  for (Index j = 0; j < motion.q.cols(); ++j) {
    const auto x = motion.q.col(j);
    const double step = (x.tail(N - 1) - x.head(N - 1)).cwiseAbs().maxCoeff();
    const double jump = std::abs(x[0] - x[N - 1]);
    if (jump > 3 * step) {
      filled.messages.push_back(fmt::format(
          "joint {} jumps by {:.3g} from its last sample to its first: not whole periods", j + 1,
          jump));
    }
  }
  SpectralStates states = spectral_derivatives(motion.q, motion.sample_time,
                                               line_below(cutoff_hz, N, motion.sample_time));
  motion.q = std::move(states.position);
  motion.dq = std::move(states.velocity);
  motion.ddq = std::move(states.acceleration);
  return filled;
}

/// With what is not given chosen from the data; not valid if the joint is at rest.
KalmanOptions kalman_options(const Eigen::VectorXd& q, double T, const JointStateOptions& options) {
  KalmanOptions kalman{options.jerk_intensity, encoder_variance(options.encoder_step)};
  if (q.minCoeff() == q.maxCoeff()) return {};
  if (kalman.measurement_variance == 0) {
    const KalmanOptions chosen = choose_kalman_options(q, T);
    kalman.measurement_variance = chosen.measurement_variance;
    if (kalman.jerk_intensity == 0) kalman.jerk_intensity = chosen.jerk_intensity;
  } else if (kalman.jerk_intensity == 0) {
    kalman.jerk_intensity = choose_jerk_intensity(q, T, kalman.measurement_variance);
  }
  return kalman;
}

Filled fill_kalman(Motion& motion, const JointStateOptions& options) {
  Filled filled;
  for (Index j = 0; j < motion.q.cols(); ++j) {
    const Eigen::VectorXd q = motion.q.col(j);
    const KalmanOptions kalman = kalman_options(q, motion.sample_time, options);
    if (!(kalman.jerk_intensity > 0 && kalman.measurement_variance > 0)) {
      filled.messages.push_back(fmt::format("joint {} is at rest", j + 1));
      continue;
    }
    const KalmanStates states = options.method == StateMethod::kKalmanFilter
                                    ? kalman_filter(q, motion.sample_time, kalman)
                                    : kalman_smoother(q, motion.sample_time, kalman);
    motion.q.col(j) = states.states.col(0);
    motion.dq.col(j) = states.states.col(1);
    motion.ddq.col(j) = states.states.col(2);
    filled.trim = std::max(filled.trim, kalman_trim(motion.sample_time, kalman));
    filled.messages.push_back(fmt::format("joint {}: jerk intensity {:.3g}, position noise {:.2g}",
                                          j + 1, kalman.jerk_intensity,
                                          std::sqrt(kalman.measurement_variance)));
  }
  return filled;
}

Filled fill_recorded(Motion& motion, const Recording& recording, const Rows& rows,
                     const JointStateOptions& options, double cutoff_hz) {
  motion.dq = recording.dq.middleRows(rows.begin, rows.count);
  if (recording.ddq.size() > 0) {
    motion.ddq = recording.ddq.middleRows(rows.begin, rows.count);
    return {};
  }
  if (motion.dq.cwiseAbs().maxCoeff() == 0) return {};
  const LowPass filter = design_butterworth(options.order, cutoff_hz, motion.sample_time);
  motion.ddq = low_pass_states(filter, motion.dq).dq;
  return {filter_trim(filter), {}};
}

/// Of all runs together; none where the longest is too short to tell.
Cutoff cutoff_of(const Recording& recording, const std::vector<Rows>& runs,
                 const std::vector<double>& sample_times) {
  constexpr Index kEnough = 64;
  std::vector<Eigen::MatrixXd> positions;
  Index longest = 0;
  double sample_time = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].count < 3) continue;
    positions.emplace_back(recording.q.middleRows(runs[r].begin, runs[r].count));
    if (runs[r].count <= longest) continue;
    longest = runs[r].count;
    sample_time = sample_times[r];
  }
  return longest < kEnough ? Cutoff{} : choose_cutoff(positions, sample_time);
}

/// One column for each joint, or one that all share; other counts say nothing of joints.
Eigen::MatrixXd temperature_of(const Recording& recording, const Rows& rows) {
  const Index columns = recording.temperature.cols(), n = recording.q.cols();
  if (columns != n && columns != 1) return {};
  const auto values = recording.temperature.middleRows(rows.begin, rows.count);
  return columns == n ? values.eval() : values.replicate(1, n).eval();
}

bool needs_cutoff(const JointStateOptions& options, const Recording& recording) {
  return options.method == StateMethod::kLowPass || options.method == StateMethod::kSpectral ||
         (options.method == StateMethod::kRecorded && recording.ddq.size() == 0 &&
          recording.dq.cwiseAbs().maxCoeff() > 0);
}

/// Whether no run moves. @param shortest  samples of a run that counts
bool all_stand(const Recording& recording, const std::vector<Rows>& runs, Index shortest) {
  bool any = false;
  for (const Rows& rows : runs) {
    if (rows.count < shortest) continue;
    if (!stands(recording.q.middleRows(rows.begin, rows.count))) return false;
    any = true;
  }
  return any;
}

Eigen::MatrixXd rows_of_any(const Eigen::MatrixXd& matrix, Index from, Index count) {
  return matrix.size() == 0 ? matrix : matrix.middleRows(from, count).eval();
}

Motion cut(const Motion& motion, Index from, Index count) {
  return {motion.sample_time,
          motion.time.segment(from, count),
          motion.q.middleRows(from, count),
          motion.dq.middleRows(from, count),
          motion.ddq.middleRows(from, count),
          rows_of_any(motion.tau, from, count),
          rows_of_any(motion.temperature, from, count),
          motion.period};
}

Filled fill(Motion& motion, const Recording& recording, const Rows& rows,
            const JointStateOptions& options, double cutoff_hz) {
  switch (options.method) {
    case StateMethod::kLowPass:
      return fill_low_pass(motion, options, cutoff_hz);
    case StateMethod::kSpectral:
      return fill_spectral(motion, cutoff_hz);
    case StateMethod::kKalmanFilter:
    case StateMethod::kKalmanSmoother:
      return fill_kalman(motion, options);
    case StateMethod::kRecorded:
      return fill_recorded(motion, recording, rows, options, cutoff_hz);
  }
  throw std::invalid_argument("joint_states(): no such method");
}

}  // namespace

void JointStateOptions::validate() const {
  const auto demand = [](bool good, const char* name, double value, const char* range) {
    if (!good) {
      throw std::invalid_argument(
          fmt::format("JointStateOptions: {} is {}, expected {}", name, value, range));
    }
  };
  demand(order >= 1 && order <= 8, "order", order, "1..8");
  demand(cutoff_hz >= 0 && std::isfinite(cutoff_hz), "cutoff_hz", cutoff_hz, "0 or more");
  demand(std::isfinite(trim), "trim", trim, "a number");
  demand(encoder_step >= 0 && std::isfinite(encoder_step), "encoder_step", encoder_step,
         "0 or more");
  demand(jerk_intensity >= 0 && std::isfinite(jerk_intensity), "jerk_intensity", jerk_intensity,
         "0 or more");
}

JointStates joint_states(const Recording& recording, const JointStateOptions& options) {
  options.validate();
  check_shapes(recording);
  if (options.method == StateMethod::kRecorded && recording.dq.size() == 0) {
    throw std::invalid_argument(
        "joint_states(): the recording has no dq; use another method than kRecorded");
  }
  constexpr Index kShortest = 8;
  const std::vector<Rows> runs = rows_of_runs(recording);
  std::vector<double> sample_times(runs.size(), 0.0);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].count < kShortest) continue;
    sample_times[r] = uniform_sample_time(recording.time.segment(runs[r].begin, runs[r].count), r);
  }
  JointStates result;
  result.stands = options.method != StateMethod::kRecorded && all_stand(recording, runs, kShortest);
  const bool filters = needs_cutoff(options, recording) && !result.stands;
  if (result.stands) {
    result.messages.push_back(
        "no joint moves by more than the noise of its positions: each run is one pose, its mean");
  }
  if (filters) {
    result.cutoff = options.cutoff_hz > 0
                        ? Cutoff{options.cutoff_hz,
                                 fmt::format("cut-off {:.3g} Hz, as told", options.cutoff_hz)}
                        : cutoff_of(recording, runs, sample_times);
    if (!result.cutoff.message.empty()) result.messages.push_back(result.cutoff.message);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Rows& rows = runs[r];
    if (rows.count < kShortest || (filters && result.cutoff.hz == 0)) {
      result.messages.push_back(fmt::format("run {} is left out: {} samples", r + 1, rows.count));
      continue;
    }
    Motion motion;
    motion.sample_time = sample_times[r];
    motion.time = recording.time.segment(rows.begin, rows.count);
    motion.q = recording.q.middleRows(rows.begin, rows.count);
    motion.dq = Eigen::MatrixXd::Zero(rows.count, motion.q.cols());
    motion.ddq = motion.dq;
    if (recording.tau.size() > 0) motion.tau = recording.tau.middleRows(rows.begin, rows.count);
    motion.temperature = temperature_of(recording, rows);
    if (result.stands) {
      motion.q.rowwise() = motion.q.colwise().mean().eval();
      result.runs.push_back(std::move(motion));
      result.first_rows.push_back(rows.begin);
      continue;
    }
    const Filled filled = fill(motion, recording, rows, options, result.cutoff.hz);
    for (const auto& message : filled.messages) {
      result.messages.push_back(fmt::format("run {}: {}", r + 1, message));
    }
    const Index trim =
        trim_samples(options.trim < 0 ? filled.trim : options.trim, motion.sample_time);
    if (2 * trim >= rows.count) {
      result.messages.push_back(fmt::format(
          "run {} is left out: {} samples, {} are cut at each end", r + 1, rows.count, trim));
      continue;
    }
    result.runs.push_back(cut(motion, trim, rows.count - 2 * trim));
    result.first_rows.push_back(rows.begin + trim);
  }
  return result;
}

}  // namespace dyngen::runtime
