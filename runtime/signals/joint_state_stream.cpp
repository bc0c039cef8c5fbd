// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/signals/joint_state.h"
#include "runtime/signals/low_pass_state.h"
#include "runtime/signals/trim.h"

// The run is continued to the left by its odd reflection as soon as that many samples are there;
// the forward pass then follows the data. Samples have their number in the run, so the reflection
// has negative ones.

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr double kUniformStep = 0.02;  // of a period: two samples, each at most one percent off

}  // namespace

void JointStateStream::Columns::drop_before(Index sample) {
  if (sample <= begin) return;
  for (auto& column : columns) {
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(sample - begin));
  }
  begin = sample;
}

JointStateStream::JointStateStream(const JointStateOptions& options, double sample_time)
    : sample_time_(sample_time) {
  options.validate();
  if (options.method != StateMethod::kLowPass || options.cutoff_hz == 0) {
    throw std::invalid_argument(
        "JointStateStream: needs the method kLowPass and a cutoff_hz, of choose_cutoff for "
        "instance");
  }
  filter_ = design_butterworth(options.order, options.cutoff_hz, sample_time);
  ends_ = end_treatment(filter_);
  trim_ = trim_samples(options.trim < 0 ? filter_trim(filter_) : options.trim, sample_time);
}

void JointStateStream::begin_run(std::size_t joints) {
  joints_ = joints;
  raw_ = {std::vector<std::vector<double>>(1 + 2 * joints), 0};
  filtered_ = {std::vector<std::vector<double>>(3 * joints), 0};
  filtering_ = false;
  emitted_ = trim_;
  any_emitted_ = false;
  ++run_;
}

std::vector<StreamPiece> JointStateStream::push(const Recording& chunk, bool continues_run) {
  std::vector<StreamPiece> pieces;
  if (chunk.samples() == 0) return pieces;
  if (chunk.q.rows() != chunk.samples() || chunk.tau.rows() != chunk.samples() ||
      chunk.tau.cols() != chunk.q.cols()) {
    throw std::invalid_argument(
        "JointStateStream::push(): q and tau must have a row for each time");
  }
  std::vector<Index> starts{0};
  for (const Index start : chunk.run_starts) {
    if (start > starts.back() && start < chunk.samples()) starts.push_back(start);
  }
  starts.push_back(chunk.samples());
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
    if (r > 0 || !continues_run || raw_.columns.empty()) {
      end_run(pieces);
      begin_run(static_cast<std::size_t>(chunk.q.cols()));
    }
    add(chunk, starts[r], starts[r + 1]);
    emit_certain(pieces);
  }
  return pieces;
}

std::vector<StreamPiece> JointStateStream::finish() {
  std::vector<StreamPiece> pieces;
  end_run(pieces);
  return pieces;
}

void JointStateStream::add(const Recording& chunk, Index from, Index to) {
  if (static_cast<std::size_t>(chunk.q.cols()) != joints_) {
    throw std::invalid_argument(fmt::format(
        "JointStateStream::push(): {} joints, before it were {}", chunk.q.cols(), joints_));
  }
  for (Index k = from; k < to; ++k) {
    auto& time = raw_.columns[0];
    if (!time.empty() &&
        !(std::abs(chunk.time[k] - time.back() - sample_time_) <= kUniformStep * sample_time_)) {
      throw std::invalid_argument(fmt::format(
          "JointStateStream::push(): {:.9g} s does not follow {:.9g} s by {:.3g} s; resample first",
          chunk.time[k], time.back(), sample_time_));
    }
    time.push_back(chunk.time[k]);
  }
  for (std::size_t j = 0; j < joints_; ++j) {
    const double* q = &chunk.q(0, static_cast<Index>(j));
    const double* tau = &chunk.tau(0, static_cast<Index>(j));
    auto& raw_q = raw_.columns[1 + j];
    auto& raw_tau = raw_.columns[1 + joints_ + j];
    raw_q.insert(raw_q.end(), q + from, q + to);
    raw_tau.insert(raw_tau.end(), tau + from, tau + to);
  }
}

/// Position, velocity and acceleration of one more sample. @param here  with neighbours
void JointStateStream::add_states(std::size_t joint, const double* here) {
  filtered_.columns[joint].push_back(*here);
  filtered_.columns[joints_ + joint].push_back(wide_first_difference(here, sample_time_));
  filtered_.columns[2 * joints_ + joint].push_back(wide_second_difference(here, sample_time_));
}

/// Puts the reflection in front of the first sample and passes it.
void JointStateStream::begin_filter() {
  const Index padding = ends_.padding;
  states_.assign(3 * joints_, PassState{});
  filtered_.begin = kDifferenceReach - padding;
  for (std::size_t j = 0; j < joints_; ++j) {
    const auto extended = [&](Index k) {
      return k >= 0 ? raw_.at(1 + j, k) : 2 * raw_.at(1 + j, 0) - raw_.at(1 + j, -k);
    };
    // as far as differences read the reflection
    std::vector<double> around;
    for (Index k = -padding; k < 2 * kDifferenceReach; ++k) around.push_back(extended(k));
    for (Index k = kDifferenceReach - padding; k < kDifferenceReach; ++k) {
      add_states(j, around.data() + k + padding);
    }
  }
  for (std::size_t c = 0; c < filtered_.columns.size(); ++c) {
    auto& column = filtered_.columns[c];
    const auto count = static_cast<Index>(column.size());
    states_[c] = start_state(filter_, column.data(), count, ends_.line_samples);
    pass_forward(filter_, states_[c], column.data(), count);
  }
  filtered_.drop_before(0);
  filtering_ = true;
}

/// The forward pass of the samples before `end`; all of them have their neighbours on each side.
void JointStateStream::filter_up_to(Index end) {
  const Index begin = filtered_.end();
  if (begin >= end) return;
  for (std::size_t j = 0; j < joints_; ++j) {
    const double* const q = raw_.columns[1 + j].data();
    for (Index k = begin; k < end; ++k) add_states(j, q + (k - raw_.begin));
  }
  for (std::size_t c = 0; c < filtered_.columns.size(); ++c) {
    double* fresh = filtered_.columns[c].data() + (begin - filtered_.begin);
    pass_forward(filter_, states_[c], fresh, end - begin);
  }
}

/// The samples up to `end`, with a backward pass that begins at `filtered_end`.
void JointStateStream::emit(Index end, Index filtered_end, std::vector<StreamPiece>& pieces) {
  const Index count = end - emitted_;
  if (count <= 0) return;
  const auto n = static_cast<Index>(joints_);
  StreamPiece piece;
  Motion& motion = piece.motion;
  motion.sample_time = sample_time_;
  motion.time.resize(count);
  for (auto* matrix : {&motion.q, &motion.dq, &motion.ddq, &motion.tau}) matrix->resize(count, n);
  for (Index k = 0; k < count; ++k) {
    motion.time[k] = raw_.at(0, emitted_ + k);
    for (Index j = 0; j < n; ++j) {
      motion.tau(k, j) = raw_.at(1 + joints_ + static_cast<std::size_t>(j), emitted_ + k);
    }
  }
  std::vector<double> pass;
  for (Index c = 0; c < 3 * n; ++c) {
    const auto& column = filtered_.columns[static_cast<std::size_t>(c)];
    pass.assign(column.begin() + (emitted_ - filtered_.begin),
                column.begin() + (filtered_end - filtered_.begin));
    pass_backward(filter_, pass.data(), filtered_end - emitted_, ends_.line_samples);
    auto& matrix = c < n ? motion.q : c < 2 * n ? motion.dq : motion.ddq;
    matrix.col(c % n) = Eigen::Map<const Eigen::VectorXd>(pass.data(), count);
  }
  piece.continues_run = any_emitted_;
  pieces.push_back(std::move(piece));
  any_emitted_ = true;
  emitted_ = end;
}

void JointStateStream::emit_certain(std::vector<StreamPiece>& pieces) {
  const Index samples = raw_.end();
  if (!filtering_) {
    if (samples < ends_.padding + 2 * kDifferenceReach) return;
    begin_filter();
  }
  filter_up_to(samples - kDifferenceReach);
  // Ahead of a piece stands what a pass needs to forget how it began, and what may yet be trimmed.
  // To wait for twice that much keeps the work of a sample constant.
  const Index ahead = std::max(ends_.padding, trim_);
  const Index end = filtered_.end();
  if (end - emitted_ < 2 * ahead) return;
  emit(end - ahead, end, pieces);
  filtered_.drop_before(emitted_);
  raw_.drop_before(std::min(emitted_, samples - 1 - std::max(ends_.padding, 2 * kDifferenceReach)));
}

void JointStateStream::end_run(std::vector<StreamPiece>& pieces) {
  if (raw_.columns.empty()) return;
  const Index samples = raw_.end();
  if (samples - 2 * trim_ <= 0 || samples < 8) {
    messages_.push_back(fmt::format("run {} is left out: {} samples, {} are cut at each end", run_,
                                    samples, trim_));
  } else if (!filtering_) {
    end_short_run(pieces);
  } else {
    // The reflection on the right, one sample of it for each that the left has.
    for (std::size_t j = 0; j < joints_; ++j) {
      auto& q = raw_.columns[1 + j];
      const std::size_t last = q.size() - 1;
      for (Index i = 1; i <= ends_.padding; ++i) {
        q.push_back(2 * q[last] - q[last - static_cast<std::size_t>(i)]);
      }
    }
    filter_up_to(samples + ends_.padding - kDifferenceReach);
    emit(samples - trim_, filtered_.end(), pieces);
  }
  raw_ = {};
  filtered_ = {};
  filtering_ = false;
}

/// A run that is shorter than its reflection would be.
void JointStateStream::end_short_run(std::vector<StreamPiece>& pieces) {
  const Index samples = raw_.end(), count = samples - 2 * trim_;
  const auto n = static_cast<Index>(joints_);
  Eigen::MatrixXd columns(samples, 1 + 2 * n);
  for (Index c = 0; c < columns.cols(); ++c) {
    columns.col(c) = Eigen::Map<const Eigen::VectorXd>(
        raw_.columns[static_cast<std::size_t>(c)].data(), samples);
  }
  const LowPassStates states = low_pass_states(filter_, columns.middleCols(1, n));
  Motion motion{sample_time_,
                columns.col(0).segment(trim_, count),
                states.q.middleRows(trim_, count),
                states.dq.middleRows(trim_, count),
                states.ddq.middleRows(trim_, count),
                columns.rightCols(n).middleRows(trim_, count)};
  pieces.push_back({std::move(motion), false});
}

}  // namespace dyngen::runtime
