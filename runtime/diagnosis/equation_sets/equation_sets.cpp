// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/equation_sets.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/diagnosis/equation_sets/repeated_motion.h"
#include "runtime/diagnosis/equation_sets/repeated_rounding.h"
#include "runtime/diagnosis/equation_sets/same_motions.h"
#include "runtime/evidence/joint_columns.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kBand = 0.9;  // of the cut-off: what is faster is damped in the joint state
constexpr double kPass =
    0.5;  // of the parallel filter: a short one, which loses less to standstill
constexpr double kSlowBand =
    0.5;  // of the band: the cut-off is twice as fast as motion is seen to be
constexpr double kHighest = 1.0 / 3;     // of the sampling frequency: a cut-off
constexpr int kSteep = 8;                // order of that low-pass
constexpr double kBesideJolts = 0.5;     // of its cut-off: what is slower is not damped at all
constexpr double kBesideStiction = 0.4;  // of that of the joint state as it is
constexpr double kWidened =
    0.5;  // over the cut-off: how far the low-pass widens a stiction interval
constexpr int kAverages =
    4;  // of the parallel filter beside stiction intervals, which is shorter still
constexpr double kLongestSample = 1e-3;  // s, of a motion that is recorded faster

RowOptions slower(RowOptions rows) {
  rows.band *= kSlowBand;
  rows.row_time /= kSlowBand;
  return rows;
}

VectorXd still_speed(const std::vector<MotionSource>& sources, const RowOptions& rows, int joints) {
  VectorXd still = VectorXd::Zero(joints);
  for (const MotionSource& source : sources) {
    still = still.cwiseMax(plan_rows(source, rows).still_speed);
  }
  return still;
}

/// @param highest  of the sampling frequency
double quick_cutoff(const MotionSource& source, double highest, const EquationRules& rules) {
  return std::max(source.cutoff.hz,
                  std::min<double>(rules.jolt_bandwidth, highest / source.sample_time));
}

/// Recordings with the joint state of an equation set.
std::vector<MotionSource> seen(const std::vector<MotionSource>& sources,
                               const EquationSetOptions& options) {
  std::vector<MotionSource> result;
  for (const MotionSource& source : sources) {
    const double hz = quick_cutoff(source, options.highest, options.rules);
    const bool quick = options.quick && source.others.low_passes;
    result.push_back(quick ? source.others.make({.order = kSteep, .hz = hz}) : source);
  }
  return result;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// Joints with stiction in one of the fitted recordings, or in any.
constexpr int kAny = -1;
std::vector<int> sticking_in(const EquationSetOptions& options, int recording) {
  std::vector<int> joints;
  for (const StictionJoint& sticking : options.sticking) {
    if (recording == kAny || sticking.sticks_in(recording)) joints.push_back(sticking.joint);
  }
  return joints;
}

/// @param fitted  whether they are the recordings that the options speak of
EffectRecordings equations(const DiagnosisInput& input, const std::vector<MotionSource>& sources,
                           const EquationSetOptions& options, bool fitted) {
  const std::vector<bool> all(static_cast<std::size_t>(input.model.joints()), true);
  EffectRecordings data = effect_recordings(input.model, input.robot, sources, options.rows, all);
  const VectorXd still = still_speed(sources, options.rows, data.joints());
  for (EffectRun& run : data.runs) {
    leave_out_standstill(run, still, options.rules);
    if (!fitted) leave_out_stiction(run, still, sticking_in(options, kAny));
  }
  leave_out_joints(data, options.masked);
  return data;
}

struct AllMotions {
  std::vector<MotionSource> own, others;
};

AllMotions motions_of(const std::vector<MotionSource>& sources, const EquationRules& rules) {
  AllMotions all;
  for (TwoMotions& two : two_motions(sources, rules)) {
    all.own.push_back(std::move(two.own));
    all.others.push_back(std::move(two.other));
  }
  return all;
}

/// Fitted recordings at the other motion of each, and at their own.
struct Fitted {
  Fitted(const DiagnosisInput& input, const AllMotions& train, const EquationSetOptions& options)
      : repeated(thinned(equations(input, train.others, options, true), kLongestSample)),
        own(thinned(equations(input, train.own, options, true), kLongestSample)),
        still(still_speed(train.own, options.rows, own.joints())) {
    find_same_motions(own, options.rules);
    for (std::size_t run = 0; run < own.runs.size(); ++run) {
      repeated.runs[run].earlier = own.runs[run].earlier;
    }
  }
  EffectRecordings repeated, own;
  VectorXd still;  // (n) rad/s or m/s
};

/// Without what is near stiction intervals.
EffectRecordings without_stiction(EffectRecordings data, const VectorXd& still,
                                  const EquationSetOptions& options) {
  for (EffectRun& run : data.runs) {
    leave_out_stiction(run, still, sticking_in(options, run.recording));
  }
  return data;
}

/// Whether each equation is made of more than one sample: otherwise none is partly inside a
/// stiction interval.
bool is_filtered(const EffectRecordings& data) {
  return std::any_of(data.runs.begin(), data.runs.end(),
                     [](const EffectRun& run) { return run.decimator.factor > 1; });
}

/// With the equations near stiction intervals, where friction is unknown. @param beta  estimate
/// from the other equations
EffectRecordings with_stiction(Fitted whole, const std::vector<MotionSource>& train,
                               const VectorXd& beta, const EquationSetOptions& options) {
  leave_as_at(whole.repeated, whole.own, beta);
  double cutoff = std::numeric_limits<double>::infinity();
  for (const MotionSource& source : train) {
    const double nyquist = 0.5 / source.sample_time;
    cutoff = std::min(cutoff, source.cutoff.hz > 0 ? source.cutoff.hz : nyquist);
  }
  for (std::size_t r = 0; r < whole.own.runs.size(); ++r) {
    EffectRun& run = whole.repeated.runs[r];
    const std::vector<int> joints = sticking_in(options, run.recording);
    mark_stiction(run, run.motion, whole.still, joints, kWidened / cutoff);
    mark_stiction(run, whole.own.runs[r].motion, whole.still, joints, kWidened / cutoff);
  }
  return std::move(whole.repeated);
}

}  // namespace

RowOptions diagnosis_rows(const std::vector<MotionSource>& train, Index decimation) {
  RowOptions rows;
  rows.decimation = decimation;
  rows.band = kBand;
  rows.multiple = kThinnedSamples;
  rows.filter.pass = kPass;
  std::vector<double> times;
  for (const MotionSource& source : train) times.push_back(plan_rows(source, rows).row_time);
  rows.row_time = median(std::move(times));
  return rows;
}

EquationSetOptions beside_stiction(const EquationSetOptions& options,
                                   const std::vector<MotionSource>& train,
                                   std::vector<StictionJoint> sticking) {
  EquationSetOptions beside = options;
  beside.sticking = std::move(sticking);
  beside.quick = std::all_of(train.begin(), train.end(), [&](const MotionSource& source) {
    return source.others.low_passes && !repeats_rounding(source, options.rules);
  });
  const bool of_halves = std::any_of(train.begin(), train.end(), [&](const MotionSource& source) {
    return source.others.parities && !repeats(source, options.rules);
  });
  beside.highest = of_halves ? kHighestOfHalf : kHighest;
  beside.rows.band = beside.quick ? kBesideJolts : kBesideStiction;
  beside.rows.multiple = 1;
  beside.rows.filter.averages = kAverages;
  std::vector<double> times;
  for (const MotionSource& source : train) {
    const double cutoff =
        beside.quick ? quick_cutoff(source, beside.highest, options.rules) : source.cutoff.hz;
    times.push_back(0.5 / (beside.rows.band * cutoff));
  }
  beside.rows.row_time = median(std::move(times));
  return beside;
}

EffectRecordings away_from_stiction(EffectRecordings data, const std::vector<MotionSource>& sources,
                                    const EquationSetOptions& options) {
  const VectorXd still = still_speed(sources, options.rows, data.joints());
  for (EffectRun& run : data.runs) {
    leave_out_stiction(run, still, sticking_in(options, kAny));
  }
  return data;
}

VectorXd counted_part(const EffectRecordings& data) {
  VectorXd counted = VectorXd::Zero(data.joints());
  for (const EffectRun& run : data.runs) counted += run.rows.counted.colwise().sum().transpose();
  return counted / static_cast<double>(data.equations());
}

EffectRecordings equations_of(const DiagnosisInput& input, const std::vector<MotionSource>& sources,
                              const EquationSetOptions& options) {
  return equations(input, seen(sources, options), options, false);
}

void leave_out_joints(EquationSets& sets, const std::vector<int>& joints) {
  for (EffectRecordings* own : {&sets.train, &sets.heldout, &sets.proof, &sets.slow}) {
    leave_out_joints(*own, joints);
  }
  if (sets.beside) leave_out_joints(*sets.beside, joints);
}

EquationSets equation_sets_of(const DiagnosisInput& input, const Division& parts,
                              const EquationSetOptions& options) {
  const AllMotions train = motions_of(seen(parts.train, options), options.rules);
  EquationSets sets;
  Fitted whole(input, train, options);
  sets.train = without_stiction(whole.repeated, whole.still, options);
  const VectorXd beta = leave_as_at(sets.train, without_stiction(whole.own, whole.still, options));
  if (!options.sticking.empty() && is_filtered(whole.own)) {
    sets.beside = with_stiction(std::move(whole), train.own, beta, options);
  }
  EquationSetOptions half = options;
  half.rows = slower(options.rows);
  Fitted slow(input, train, half);
  sets.slow = without_stiction(std::move(slow.repeated), slow.still, half);
  leave_as_at(sets.slow, without_stiction(std::move(slow.own), slow.still, half));
  sets.heldout = equations_of(input, parts.heldout, options);
  for (EffectRun& run : sets.heldout.runs) run.recording = -1 - run.recording;
  sets.proof = sets.heldout;
  leave_out_unvisited(sets.proof, sets.train, options.rules);
  return sets;
}

}  // namespace dyngen::runtime
