// SPDX-License-Identifier: MIT
#include "tests/blind/cases/case.h"

#include <algorithm>
#include <cmath>

#include "tests/blind/cases/draw.h"
#include "tests/blind/cases/record.h"
#include "tests/blind/cases/rivals.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPilotRounds = 6, kRounds = 3;  // of the search for a size
constexpr double kNear = 1.3;                 // of the wanted strength, either way

std::vector<Recording> record_all(const Draft& draft, const std::vector<Truth>& truths,
                                  const std::vector<double>& sizes, std::size_t first,
                                  std::size_t last) {
  std::vector<Recording> all;
  for (std::size_t run = first; run < last; ++run) {
    all.push_back(record(draft, truths, sizes, ride_of(draft, run)));
  }
  return all;
}

/// What equations can hold that are made of filtered positions, beside joints that stick: nothing
/// faster than the joint state, nothing within a filter's reach of a rest.
struct Reach {
  double hz = 0;       // 0: all that was recorded
  double seconds = 0;  // around a rest
};
constexpr Reach kFiltered{20, 0.04};

/// Training recordings in the coordinates in which noise is white.
struct Whitened {
  Whitened(const Machine& machine, const std::vector<Recording>& training, const Whitener& noise,
           const Reach& reach = {})
      : whitener(noise) {
    if (reach.hz > 0) whitener.stop_above(reach.hz, training.front().log.rate);
    std::vector<MatrixXd> columns;
    for (const Recording& each : training) {
      const RestWhitener white(whitener, each.log, reach.seconds);
      columns.push_back(white(base_columns(machine, each.log)));
      const VectorXd tau = torque_rows(known_torque(each));
      torque.emplace_back(white(tau));
      left_out.emplace_back(white(tau - base_torque(machine, each.log)));
    }
    refit.emplace(std::move(columns));
    left = refit->residual(torque);
  }
  double lambda() const { return squares(left); }
  double absorbed() const { return 1 - lambda() / std::max(squares(left_out), 1e-300); }

  Whitener whitener;
  std::optional<Refit> refit;
  std::vector<VectorXd> torque, left_out, left;
};

struct Sized {
  double size = 0, lambda = 0, absorbed = 0;
};

/// The size at which one truth alone has the wanted strength, within a third: sought on one
/// recording, then measured on all.
std::optional<Sized> find_size(const Draft& draft, const Truth& truth, const Whitener& noise,
                               double wanted) {
  const auto strength = [&](double size, std::size_t first, std::size_t last) {
    const Whitened whitened(draft.machine, record_all(draft, {truth}, {size}, first, last), noise);
    return Sized{size, whitened.lambda(), whitened.absorbed()};
  };
  const auto run = truth.numbers.find("run");
  const bool passes = run != truth.numbers.end();
  const std::size_t pilot = passes ? static_cast<std::size_t>(run->second) : 0;
  const auto better = [&](const Sized& now, double aim) {
    const double factor = std::clamp(std::sqrt(aim / std::max(now.lambda, 1e-12)), 0.05, 20.0);
    return std::clamp(now.size * factor, truth.least, truth.most);
  };
  double size = std::clamp(truth.typical, truth.least, truth.most);
  const double aim = passes ? wanted : wanted / static_cast<double>(draft.training);
  for (int round = 0; round < kPilotRounds; ++round) {
    const Sized now = strength(size, pilot, pilot + 1);
    const double next = better(now, aim);
    const bool near = now.lambda < aim * kNear && now.lambda > aim / kNear;
    if (near) break;
    if (next == size) return {};  // at a bound
    size = next;
  }
  for (int round = 0; round < kRounds; ++round) {
    const Sized now = strength(size, 0, draft.training);
    if (now.lambda < wanted * kNear && now.lambda > wanted / kNear) return now;
    size = better(now, wanted);
  }
  return {};
}

/// Who has recordings alone cannot know the friction of a joint that rests: sign(0) = 0.
Log as_seen(Log log) {
  for (double& sign : log.sign.reshaped()) {
    if (std::abs(sign) < 1) sign = 0;
  }
  return log;
}

/// Held-out rms by joint of a fit to the noisy training torque.
/// @param with_truth  the fit knows the form of what is left out
/// @param with_drive  and the drive's own compensation
std::vector<double> heldout_rms(const Draft& draft, const std::vector<Recording>& training,
                                const std::vector<Recording>& heldout, const Whitener& noise,
                                bool with_truth, bool with_drive) {
  const auto torque_of = [&](const Recording& each) {
    MatrixXd tau = each.log.recorded + each.torque_noise;
    if (with_drive && each.compensation.size() > 0) tau += each.compensation;
    return torque_rows(tau);
  };
  const auto equations = [&](const Recording& each, const Log& log) {
    MatrixXd columns = base_columns(draft.machine, log);
    if (with_truth) {
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.rightCols(1) = torque_rows(known_torque(each)) - base_torque(draft.machine, each.log);
    }
    return columns;
  };
  std::vector<MatrixXd> columns;
  std::vector<VectorXd> torque;
  for (const Recording& each : training) {
    const MatrixXd own = equations(each, each.log);
    const MatrixXd tau = torque_of(each);
    const RestWhitener white(noise, each.log);
    columns.push_back(white(own));
    torque.emplace_back(white(tau));
  }
  const VectorXd answer = Refit(std::move(columns)).solve(torque);
  const Index joints = draft.machine.joints();
  VectorXd sum = VectorXd::Zero(joints);
  double samples = 0;
  for (const Recording& each : heldout) {
    const VectorXd left = torque_of(each) - equations(each, as_seen(each.log)) * answer;
    const Index count = each.log.q.rows();
    samples += static_cast<double>(count);
    for (Index j = 0; j < joints; ++j) sum[j] += left.segment(j * count, count).squaredNorm();
  }
  std::vector<double> rms;
  for (const double each : sum) rms.push_back(std::sqrt(each / samples));
  return rms;
}

/// Effects that a case needs: a crowd goes without those that do not reach their strength.
std::size_t least_truths(const CaseOptions& options, const Draft& draft) {
  if (options.kind != "crowd") return draft.truths.size();
  return draft.arm.joints() < 3 ? 4 : 5;
}

}  // namespace

std::optional<Case> make_case(const CaseOptions& options, const std::string& arms) {
  const auto drawn = draw_case(options, arms);
  if (!drawn) return {};
  const Draft& draft = *drawn;
  Case made;
  made.options = options;
  made.arm = draft.arm.name;
  made.engine = draft.engine == mujoco_engine ? "MuJoCo" : "DART";
  made.loop = draft.loop.kind == Loop::kPd    ? "PD"
              : draft.loop.kind == Loop::kPid ? "PID"
                                              : "computed torque";
  made.machine = draft.machine;
  made.noise = draft.noise;
  made.rate = draft.rate;
  made.length = ride_of(draft, 0).duration;
  made.periods = draft.periods;
  made.logger = draft.logger;
  made.disturbance = draft.disturbance_share;
  made.memory = draft.memory;
  made.compensation = draft.compensation;
  const VectorXd deviation = noise_deviation(draft);
  made.noise.deviation = deviation;
  const Whitener noise = whitener_of(draft, deviation);
  const std::size_t least = least_truths(options, draft);
  for (std::size_t i = 0; i < draft.truths.size(); ++i) {
    const Truth& truth = draft.truths[i];
    Sized one{truth.typical, 0, 1};  // of what is hidden nothing is left: it has its usual size
    if (options.kind != "hidden") {
      const auto sized = find_size(draft, truth, noise, draft.wanted[i]);
      if (!sized && made.truths.size() + draft.truths.size() - i - 1 < least) return {};
      if (!sized) continue;
      one = *sized;
    }
    made.truths.push_back(truth);
    made.wanted.push_back(draft.wanted[i]);
    made.sizes.push_back(one.size);
    made.lambdas.push_back(one.lambda);
    made.absorbed.push_back(one.absorbed);
  }
  const std::size_t all = draft.motions.size();
  std::vector<Recording> recordings = record_all(draft, made.truths, made.sizes, 0, all);
  add_noise(draft, deviation, recordings);
  const auto first_heldout = recordings.begin() + static_cast<std::ptrdiff_t>(draft.training);
  made.training.assign(recordings.begin(), first_heldout);
  made.heldout.assign(first_heldout, recordings.end());
  if (!options.noisy) return made;
  const Whitened whitened(draft.machine, made.training, noise);
  double rows = 0;
  for (const VectorXd& each : whitened.left) rows += static_cast<double>(each.size());
  made.excess = std::sqrt(1 + whitened.lambda() / rows) - 1;
  made.filtered = Whitened(draft.machine, made.training, noise, kFiltered).lambda();
  if (options.kind == "single") {
    made.imitated = imitated_shares(draft.machine, made.truths.front(), made.training,
                                    whitened.whitener, *whitened.refit, whitened.left);
  }
  made.heldout_oracle =
      heldout_rms(draft, made.training, made.heldout, noise, !made.truths.empty(), true);
  made.heldout_base = heldout_rms(draft, made.training, made.heldout, noise, false, false);
  return made;
}

}  // namespace blind
