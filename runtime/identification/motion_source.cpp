// SPDX-License-Identifier: MIT
#include "runtime/identification/motion_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "runtime/identification/stretches.h"
#include "runtime/recordings/clipping.h"
#include "runtime/recordings/clock.h"
#include "runtime/recordings/periods.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/signal_repair.h"
#include "runtime/recordings/time_base.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kChunk = 20000;

/// One number throughout, of a joint that moves or in poses that differ: no torque is so.
bool torque_is_dead(const Recording& recording, int joint) {
  if (recording.tau.size() == 0 || recording.samples() < 2) return false;
  const auto torque = recording.tau.col(joint);
  const auto position = recording.q.col(joint);
  return torque.minCoeff() == torque.maxCoeff() && position.minCoeff() < position.maxCoeff();
}

void look_at_signals(const Recording& recording, RecordingCondition& condition) {
  for (int j = 0; j < recording.joints(); ++j) {
    const Quantisation position = find_quantisation(recording.q.col(j));
    condition.position_step.push_back(position.step);
    const Clipping clipping = find_clipping(recording.tau.col(j));
    condition.torque_clipped.push_back(clipping.clipped);
    condition.torque_dead.push_back(torque_is_dead(recording, j));
    if (clipping.clipped) {
      condition.messages.push_back(fmt::format(
          "torque of joint {} stands at its limit ({:.4g} or {:.4g}) in {} samples", j + 1,
          clipping.lower, clipping.upper, clipping.at_lower + clipping.at_upper));
    }
  }
}

Recording with_uniform_time(Recording recording, RecordingCondition& condition) {
  const TimeBase base = examine_time_base(recording);
  condition.sample_time = base.sample_time;
  condition.jitter = base.jitter;
  if (base.uniform) return recording;
  condition.resampled = true;
  ClockChoice clock = choose_clock(recording);
  if (!clock.rebuilt) {
    condition.messages.push_back(
        base.message + fmt::format("; resampled to {:.6g} s; {}", base.sample_time, clock.message));
    return resample(recording, base.sample_time);
  }
  condition.messages.push_back(base.message + "; " + clock.message);
  recording.time = std::move(clock.time);
  condition.sample_time = clock.step;
  // samples that were lost are all that is uneven now
  return examine_time_base(recording).uniform ? recording : resample(recording, clock.step);
}

/// Of each run.
std::vector<Periods> periods_of_runs(const Recording& recording, std::optional<double> given) {
  std::vector<Periods> periods;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run], count = run_end(recording, run) - first;
    Recording positions;
    positions.time = recording.time.segment(first, count);
    positions.q = recording.q.middleRows(first, count);
    positions.run_starts = {0};
    periods.push_back(find_periods(positions, given));
  }
  return periods;
}

/// None where there are no periods.
std::optional<Recording> averaged_periods(const Recording& recording, const MotionOptions& options,
                                          const std::vector<Periods>& found,
                                          RecordingCondition& condition) {
  if (!options.average_periods) return std::nullopt;
  if (recording.run_starts.size() > 1) {
    // the mean of one run's periods would stand for all runs
    condition.messages.push_back(
        fmt::format("{} runs: all of them are used as they are; periods are averaged where a file "
                    "holds one run",
                    recording.run_starts.size()));
    return std::nullopt;
  }
  const Periods& periods = found.front();
  if (periods.samples == 0) {
    if (options.period) condition.messages.push_back(periods.message);
    return std::nullopt;
  }
  condition.periods = periods.count;
  condition.period = periods.period;
  condition.messages.push_back(periods.message);
  if (periods.count < 2) return std::nullopt;
  condition.period_scatter = column_rms(period_scatter(recording, periods)).transpose();
  Recording averaged = average_periods(recording, periods);
  condition.sample_time = periods.period / static_cast<double>(periods.samples);
  return averaged;
}

/// Standard deviation of position noise: what lies above the cut-off, as if it were white.
VectorXd noise_of_positions(const Recording& recording, const JointStates& states,
                            double sample_time, const std::vector<double>& steps) {
  VectorXd squares = VectorXd::Zero(recording.joints());
  double samples = 0;
  for (std::size_t i = 0; i < states.runs.size(); ++i) {
    const Motion& run = states.runs[i];
    const auto measured = recording.q.middleRows(states.first_rows[i], run.samples());
    squares += (measured - run.q).colwise().squaredNorm().transpose();
    samples += static_cast<double>(run.samples());
  }
  const double above =
      std::max(0.1, 1 - 2 * sample_time * states.cutoff.hz);  // part of the band above the cut-off
  VectorXd noise = (squares / std::max(samples, 1.0) / above).cwiseSqrt();
  for (Index j = 0; j < noise.size(); ++j) {
    noise[j] = std::max(noise[j], steps[static_cast<std::size_t>(j)] / std::sqrt(12.0));
  }
  return noise;
}

void check_runs(const JointStates& states, const std::string& name) {
  if (!states.runs.empty()) return;
  std::string reason;
  for (const std::string& message : states.messages) reason += "; " + message;
  throw TooLittleDataError(fmt::format("{}: no run is long enough{}", name, reason));
}

/// Whether noise of positions is more of a joint's acceleration than numbers are rounded.
/// @param noise  (n) standard deviation of positions, as if they were white
bool accelerations_are_noisy(const JointStates& states, const VectorXd& noise, double sample_time) {
  constexpr double kNoise = 1e-7;  // of the square: a hundredth of its root, behind quick filters
  VectorXd squares = VectorXd::Zero(noise.size());
  double samples = 0;
  for (const Motion& run : states.runs) {
    squares += run.ddq.colwise().squaredNorm().transpose();
    samples += static_cast<double>(run.samples());
  }
  // of a density up to the cut-off, times the fourth power of the frequency
  const double gain =
      2 * sample_time * std::pow(2 * std::numbers::pi, 4) * std::pow(states.cutoff.hz, 5) / 5;
  return (gain * noise.cwiseAbs2() * samples - kNoise * squares).maxCoeff() > 0;
}

Recording with_every_other(Recording recording, int parity) {
  std::vector<Index> ends = recording.run_starts;
  ends.push_back(recording.samples());
  for (std::size_t run = 0; run + 1 < ends.size(); ++run) {
    auto rows = recording.q.middleRows(ends[run], ends[run + 1] - ends[run]);
    rows = of_every_other(rows, parity);
  }
  return recording;
}

/// @param recording  of uniform time, its condition looked at   @param start  s, before averaging
/// @param periods    of each run; empty: none repeats
/// @param chosen     the cut-off, where options leave it open; 0 Hz: chosen from this recording
MotionSource filtered(const std::shared_ptr<const Recording>& recording, double start,
                      RecordingCondition condition, const JointStateOptions& options,
                      const std::vector<Periods>& periods, const Cutoff& chosen = {}) {
  MotionSource source;
  source.name = recording->file_name;
  source.start = start;
  JointStateOptions settled = options;
  if (chosen.hz > 0) settled.cutoff_hz = chosen.hz;
  JointStates states = joint_states(*recording, settled);
  if (chosen.hz > 0 && states.cutoff.hz > 0) {
    states.cutoff = chosen;
    states.messages.front() = chosen.message;
  }
  check_runs(states, source.name);
  for (std::size_t i = 0; i < states.runs.size() && !periods.empty(); ++i) {
    const auto& starts = recording->run_starts;
    const auto next = std::upper_bound(starts.begin(), starts.end(), states.first_rows[i]);
    states.runs[i].period = periods[static_cast<std::size_t>(next - starts.begin()) - 1].period;
  }
  condition.stands = states.stands;
  source.sample_time = states.runs.front().sample_time;
  source.cutoff = states.cutoff;
  source.position_noise =
      noise_of_positions(*recording, states, source.sample_time, condition.position_step);
  source.fastest = VectorXd::Zero(recording->joints());
  for (const Motion& run : states.runs) {
    source.fastest = source.fastest.cwiseMax(run.dq.cwiseAbs().colwise().maxCoeff().transpose());
  }
  source.others.low_passes = options.method == StateMethod::kLowPass && !(options.cutoff_hz > 0);
  const bool quick = source.cutoff.hz * source.sample_time > kHighestOfHalf * (1 + 1e-9);
  source.others.parities =
      options.method == StateMethod::kLowPass && !quick &&
      accelerations_are_noisy(states, source.position_noise, source.sample_time);
  if (source.others.low_passes && !states.stands) {
    source.others.at = [recording, start, condition, options, periods](const Cutoff& cutoff,
                                                                       double trim) {
      JointStateOptions other = options;
      if (trim >= 0) other.trim = trim;
      return filtered(recording, start, condition, other, periods, cutoff);
    };
  }
  if (source.others.low_passes || source.others.parities) {
    source.others.make = [recording, start, condition, options, periods, hz = source.cutoff.hz,
                          noise = source.position_noise](const OtherState& state) {
      JointStateOptions other = options;
      other.cutoff_hz = hz;
      if (state.order > 0) {
        other.order = state.order;
        other.cutoff_hz = state.hz;
        return filtered(recording, start, condition, other, periods);
      }
      auto half = std::make_shared<const Recording>(with_every_other(*recording, state.parity));
      MotionSource of_half = filtered(half, start, condition, other, periods);
      of_half.position_noise = noise;
      return of_half;
    };
  }
  condition.messages.insert(condition.messages.end(), states.messages.begin(),
                            states.messages.end());
  source.condition = std::move(condition);
  auto runs = std::make_shared<const std::vector<Motion>>(std::move(states.runs));
  source.pieces = [runs](const std::function<void(const StreamPiece&)>& visit) {
    for (const Motion& run : *runs) visit({run, false});
  };
  return source;
}

/// @param start  s, time stamp of the first sample of the whole recording
MotionSource motion_in_memory(Recording recording, double start, RecordingCondition condition,
                              const MotionOptions& options) {
  look_at_signals(recording, condition);
  const auto recorded =
      std::make_shared<const Recording>(with_uniform_time(std::move(recording), condition));
  auto used = recorded;
  std::vector<Periods> periods = periods_of_runs(*recorded, options.period);
  if (std::optional<Recording> averaged =
          averaged_periods(*recorded, options, periods, condition)) {
    used = std::make_shared<const Recording>(std::move(*averaged));
    periods.clear();
  }
  MotionSource source = filtered(used, start, std::move(condition), options.state, periods);
  source.recorded = recorded;
  return source;
}

MotionSource motion_in_memory(Recording recording, RecordingCondition condition,
                              const MotionOptions& options) {
  const double start = recording.samples() > 0 ? recording.time[0] : 0;
  return motion_in_memory(std::move(recording), start, std::move(condition), options);
}

/// What the first part of a large file says of all of it.
MotionSource stream_of(const RecordingInput& input, MotionOptions options,
                       std::vector<Notice>& told) {
  constexpr Index kFirstPart = 200000;
  ReadOptions reading;
  Recording first;
  RecordingReader reader = input.open(reading);
  reader.next(first, kFirstPart);
  if (stamps_are_repeated(reader) && input.reopens) {
    reading.spread_stamps = true;
    reader = input.open(reading);
    reader.next(first, kFirstPart);
  }
  told.insert(told.end(), reader.notices().begin(), reader.notices().end());
  const TimeBase base = examine_time_base(first);
  if (!base.uniform) {
    throw std::invalid_argument(
        fmt::format("{}: {}: expected a uniform time base, since the file is too large to be "
                    "resampled in memory",
                    input.name, base.message));
  }
  MotionOptions of_first = options;
  of_first.average_periods = false;
  const MotionSource of_part = motion_in_memory(std::move(first), {}, of_first);
  options.state.cutoff_hz = of_part.cutoff.hz;
  const auto pieces = [input, reading, state = options.state, sample_time = base.sample_time](
                          const std::function<void(const StreamPiece&)>& visit) {
    RecordingReader again = input.open(reading);
    JointStateStream stream(state, sample_time);
    Recording chunk;
    while (again.next(chunk, kChunk)) {
      for (const StreamPiece& piece : stream.push(chunk, again.continues_run())) visit(piece);
    }
    for (const StreamPiece& piece : stream.finish()) visit(piece);
  };
  MotionSource source = with_pieces(of_part, pieces);
  source.name = input.name;
  source.condition.messages.push_back("read piece by piece; periods were not looked for");
  return source;
}

/// Long enough for two periods of a motion that repeats, behind a filter that cuts its ends. More
/// than a fifth of what is read is no stretch.
double seconds_of_stretch(const Recording& first, const MotionOptions& options) {
  constexpr double kPeriods = 2.5, kMost = 0.2;
  const double usual = StretchOptions().seconds;
  if (first.samples() < 2 || first.run_starts.size() != 1) return usual;
  const double sample_time =
      (first.time[first.samples() - 1] - first.time[0]) / static_cast<double>(first.samples() - 1);
  const double in_all =
      options.numbers_of_stretches / numbers_of_rows(1, first.joints(), sample_time) * sample_time;
  const Periods periods = find_periods(first, options.period);
  const double wanted = periods.count >= 2 ? kPeriods * periods.period : 0;
  return wanted <= kMost * in_all ? std::max(usual, wanted) : usual;
}

/// What says most of a long recording.
MotionSource motion_of_stretches(const RecordingInput& input, const MotionOptions& options,
                                 std::vector<Notice>& told) {
  ReadOptions reading;
  StretchOptions choice;
  choice.most_numbers = options.numbers_of_stretches;
  {
    constexpr Index kSeen = 20000;
    RecordingReader reader = input.open(reading);
    Recording first;
    reader.next(first, kSeen);
    reading.spread_stamps = stamps_are_repeated(reader) && input.reopens;
    choice.seconds = seconds_of_stretch(first, options);
  }
  Stretches stretches = telling_stretches(input, reading, choice, &told);
  repair_signals(stretches.recording, told);
  RecordingCondition condition;
  condition.repairs = told;
  condition.stretches = std::move(stretches.times);
  condition.messages.push_back(stretches.sentence);
  told.push_back({input.name, 0, 0, stretches.sentence});
  return motion_in_memory(std::move(stretches.recording), stretches.start, std::move(condition),
                          options);
}

bool is_long(const Recording& recording, const MotionOptions& options) {
  const Index samples = recording.samples();
  if (samples < 2 || !std::isfinite(options.numbers_above)) return false;
  const double seconds = recording.time[samples - 1] - recording.time[0];
  const double sample_time = seconds / static_cast<double>(samples - 1);
  return seconds > options.read_whole &&
         numbers_of_rows(samples, recording.joints(), sample_time) > options.numbers_above;
}

}  // namespace

MotionSource motion_of(Recording recording, const MotionOptions& options) {
  return motion_in_memory(std::move(recording), {}, options);
}

MotionSource motion_of_file(const std::string& path, const MotionOptions& options,
                            std::vector<Notice>* repairs) {
  return motion_of_input(recording_file(path), options, repairs);
}

MotionSource motion_of_input(const RecordingInput& input, const MotionOptions& options,
                             std::vector<Notice>* repairs) {
  std::vector<Notice> own;
  std::vector<Notice>& told = repairs != nullptr ? *repairs : own;
  if (input.text_bytes > options.stretches_above) return motion_of_stretches(input, options, told);
  if (input.text_bytes > options.stream_above && options.state.method == StateMethod::kLowPass) {
    return stream_of(input, options, told);
  }
  RecordingCondition condition;
  const auto before = static_cast<std::ptrdiff_t>(told.size());
  Recording recording = read_recording(input, {}, &told);
  if (input.reopens && is_long(recording, options)) {
    recording = {};  // its memory is needed
    told.erase(told.begin() + before, told.end());
    return motion_of_stretches(input, options, told);
  }
  condition.repairs = told;
  return motion_in_memory(std::move(recording), std::move(condition), options);
}

MotionSource with_pieces(
    const MotionSource& source,
    std::function<void(const std::function<void(const StreamPiece&)>&)> pieces) {
  MotionSource other = source;
  other.others = {};
  other.pieces = std::move(pieces);
  return other;
}

MotionSource made_of(const MotionSource& source,
                     const std::function<MotionSource(const MotionSource&)>& change) {
  MotionSource made = change(source);
  made.others = source.others;
  if (source.others.make) {
    made.others.make = [make = source.others.make, change](const OtherState& state) {
      return made_of(make(state), change);
    };
  }
  if (source.others.at) {
    made.others.at = [at = source.others.at, change](const Cutoff& cutoff, double trim) {
      return made_of(at(cutoff, trim), change);
    };
  }
  return made;
}

namespace {

/// One joint state's part: see part_of().
MotionSource cut_out(const MotionSource& source, double from, double to) {
  // lengths of the runs first: pieces of a run do not know how long it is
  auto known = std::make_shared<std::vector<Index>>();
  return with_pieces(source, [all = source.pieces, from, to,
                              known](const std::function<void(const StreamPiece&)>& visit) {
    std::vector<Index>& lengths = *known;
    if (lengths.empty()) {
      all([&](const StreamPiece& piece) {
        if (!piece.continues_run) lengths.push_back(0);
        lengths.back() += piece.motion.samples();
      });
    }
    std::size_t run = 0;
    Index place = 0;
    bool any = false;
    all([&](const StreamPiece& piece) {
      if (!piece.continues_run) {
        run += any ? 1 : 0;
        place = 0;
        any = true;
      }
      const double length = static_cast<double>(lengths[run]);
      const Index begin = static_cast<Index>(std::llround(from * length));
      const Index end = static_cast<Index>(std::llround(to * length));
      const Index first = std::max(begin, place),
                  last = std::min(end, place + piece.motion.samples());
      if (first < last) {
        const Index skip = first - place, count = last - first;
        StreamPiece cut;
        const Motion& motion = piece.motion;
        cut.motion = {motion.sample_time,
                      motion.time.segment(skip, count),
                      motion.q.middleRows(skip, count),
                      motion.dq.middleRows(skip, count),
                      motion.ddq.middleRows(skip, count),
                      motion.tau.middleRows(skip, count),
                      motion.temperature.size() == 0
                          ? motion.temperature
                          : motion.temperature.middleRows(skip, count).eval(),
                      motion.period};
        cut.continues_run = first > begin;
        visit(cut);
      }
      place += piece.motion.samples();
    });
  });
}

}  // namespace

MotionSource part_of(const MotionSource& source, double from, double to) {
  return made_of(source,
                 [from, to](const MotionSource& state) { return cut_out(state, from, to); });
}

}  // namespace dyngen::runtime
