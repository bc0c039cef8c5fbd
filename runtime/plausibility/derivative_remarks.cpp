// SPDX-License-Identifier: MIT
#include "runtime/plausibility/derivative_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "runtime/recordings/time_base.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDerivativeScale = 0.05;  // of a derivative beside differences
constexpr double kGoesWith = 0.5;          // correlation below which a column says nothing
constexpr double kIsOther = 0.9;           // correlation with which it is another joint's
// standard deviation of differences over their noise, which makes slopes too small by 1/kSnr^2
constexpr double kDerivativeSnr = 10;
constexpr Index kNarrowest = 3, kWidest = 48;  // samples on either side of a difference
// of the fastest joint's speed: a slower one is held while others move, and drives filter such speeds
constexpr double kHeldStill = 0.02;
constexpr double kMostLagTime = 0.05;      // s
constexpr Index kMostLagSamples = 100;

/// Standard deviation of white noise and rounding, from third differences: those of noise of
/// deviation s have s sqrt(20).
double white_noise(const Eigen::Ref<const VectorXd>& x) {
  const Index n = x.size() - 3;
  if (n < 1) return 0;
  return std::sqrt(
      (x.tail(n) - 3 * x.segment(2, n) + 3 * x.segment(1, n) - x.head(n)).squaredNorm() /
      (20.0 * static_cast<double>(n)));
}

/// Of samples a and b: correlation about zero, and the factor that makes b of a.
struct Likeness {
  double correlation = 0, slope = 0;
};

Likeness likeness(const Eigen::Ref<const VectorXd>& a, const Eigen::Ref<const VectorXd>& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  if (!(aa > 0 && bb > 0)) return {};
  return {ab / std::sqrt(aa * bb), ab / aa};
}

double deviation(const VectorXd& x) {
  if (x.size() == 0) return 0;
  return std::sqrt((x.array() - x.mean()).square().mean());
}

/// A column and the one that it is the derivative of, over windows of 2 half + 1 samples.
struct Windows {
  VectorXd own;    ///< differences of the lower one
  VectorXd given;  ///< the column's mean, by the trapezoid rule
};

/// How a column goes with differences.
struct Verdict {
  bool judged = false;
  Likeness here, best;
  Index lag = 0;  ///< samples
};

/// The columns of one kind beside the columns that they are derivatives of.
class DerivativeCheck {
 public:
  /// @param lower, upper  matrices of the recording   @param lower_name, upper_name  "q", "qd"
  DerivativeCheck(const Recording& recording, const MatrixXd& lower, const MatrixXd& upper,
                  const char* lower_name, const char* upper_name, double sample_time,
                  std::vector<Remark>& remarks)
      : recording_(recording),
        lower_(lower),
        upper_(upper),
        lower_name_(lower_name),
        upper_name_(upper_name),
        sample_time_(sample_time),
        remarks_(remarks) {
    constexpr Index kHalf = 12;
    for (Index j = 0; j < upper.cols(); ++j) {
      speeds_.push_back(deviation(windows(j, j, kHalf).own));
      fastest_ = std::max(fastest_, speeds_.back());
    }
  }

  [[nodiscard]] std::vector<DerivativeFit> fits() const {
    std::vector<DerivativeFit> all;
    for (Index j = 0; j < upper_.cols(); ++j) {
      const std::optional<Index> half = half_width(j);
      const Verdict verdict = half ? compare(j, j, *half) : Verdict();
      all.push_back({verdict.judged, verdict.best.correlation, verdict.best.slope,
                     sample_time_ * static_cast<double>(verdict.lag)});
    }
    return all;
  }

  void run() {
    std::vector<std::pair<Index, Verdict>> scaled;
    for (Index j = 0; j < upper_.cols(); ++j) {
      const Verdict verdict = judge(j);
      if (verdict.judged) scaled.emplace_back(j, verdict);
    }
    judge_scales(scaled);
    for (const auto& [j, verdict] : scaled) judge_lag(j, verdict);
  }

 private:
  void add(const char* kind, Index joint, std::string text) {
    remarks_.push_back(
        {kind, false, static_cast<int>(joint), recording_.file_name, std::move(text)});
  }
  [[nodiscard]] Windows windows(Index lower, Index upper, Index half) const;
  [[nodiscard]] std::optional<Index> half_width(Index joint) const;
  [[nodiscard]] Verdict compare(Index lower, Index upper, Index half) const;
  Verdict judge(Index j);
  void judge_scales(const std::vector<std::pair<Index, Verdict>>& all);
  void judge_lag(Index j, const Verdict& verdict);
  [[nodiscard]] std::string meaning(double slope) const;

  const Recording& recording_;
  const MatrixXd &lower_, &upper_;
  std::string lower_name_, upper_name_;
  double sample_time_;
  std::vector<Remark>& remarks_;
  std::vector<double> speeds_;  ///< standard deviation of each joint's differences
  double fastest_ = 0;          ///< the largest of them
};

Windows DerivativeCheck::windows(Index lower, Index upper, Index half) const {
  std::vector<double> own, given;
  for (std::size_t run = 0; run < recording_.run_starts.size(); ++run) {
    const Index first = recording_.run_starts[run], end = run_end(recording_, run);
    for (Index k = first + half; k + half < end; ++k) {
      const double time = recording_.time[k + half] - recording_.time[k - half];
      own.push_back((lower_(k + half, lower) - lower_(k - half, lower)) / time);
      const double sum = upper_.block(k - half, upper, 2 * half + 1, 1).sum() -
                         (upper_(k - half, upper) + upper_(k + half, upper)) / 2;
      given.push_back(sum / static_cast<double>(2 * half));
    }
  }
  return {Eigen::Map<const VectorXd>(own.data(), static_cast<Index>(own.size())),
          Eigen::Map<const VectorXd>(given.data(), static_cast<Index>(given.size()))};
}

/// The narrowest window in which a joint's motion stands out of noise; nothing: it does not move.
std::optional<Index> DerivativeCheck::half_width(Index joint) const {
  if (speeds_[static_cast<std::size_t>(joint)] < kHeldStill * fastest_) return std::nullopt;
  const double noise = white_noise(lower_.col(joint));
  for (Index half = kNarrowest; half <= kWidest; half *= 2) {
    const VectorXd own = windows(joint, joint, half).own;
    const double of_noise =
        noise * std::numbers::sqrt2 / (2 * static_cast<double>(half) * sample_time_);
    if (deviation(own) > kDerivativeSnr * of_noise && deviation(own) > 0) return half;
  }
  return std::nullopt;
}

Verdict DerivativeCheck::compare(Index lower, Index upper, Index half) const {
  const Windows both = windows(lower, upper, half);
  const Index most =
      std::min<Index>(static_cast<Index>(kMostLagTime / sample_time_), kMostLagSamples);
  Verdict verdict;
  const Index count = both.own.size() - 2 * most;
  if (count < 2 * most + 64) return verdict;
  verdict.judged = true;
  const auto own = both.own.segment(most, count);
  verdict.here = likeness(own, both.given.segment(most, count));
  for (Index shift = -most; shift <= most; ++shift) {
    const Likeness shifted = likeness(own, both.given.segment(most + shift, count));
    if (std::abs(shifted.correlation) <= std::abs(verdict.best.correlation) + 1e-6) continue;
    verdict.best = shifted;
    verdict.lag = shift;
  }
  return verdict;
}

Verdict DerivativeCheck::judge(Index j) {
  const std::optional<Index> half = half_width(j);
  if (!half) return {};
  if (upper_.col(j).cwiseAbs().maxCoeff() == 0) {
    add("velocity", j + 1,
        fmt::format("{0}{2} is 0 throughout while {1}{2} moves: it was not measured", upper_name_,
                    lower_name_, j + 1));
    return {};
  }
  Verdict verdict = compare(j, j, *half);
  // noise of the column may hide it: wider windows
  for (Index wider = 2 * *half;
       wider <= kWidest && verdict.judged && std::abs(verdict.best.correlation) < kGoesWith;
       wider *= 2) {
    verdict = compare(j, j, wider);
  }
  if (!verdict.judged || std::abs(verdict.best.correlation) >= kGoesWith) return verdict;
  Index other = j;
  double most = kIsOther;
  for (Index m = 0; m < lower_.cols(); ++m) {
    const std::optional<Index> width = m == j ? std::nullopt : half_width(m);
    if (!width) continue;
    const double likeness_of_other = std::abs(compare(m, j, *width).best.correlation);
    if (likeness_of_other <= most) continue;
    most = likeness_of_other;
    other = m;
  }
  if (other != j) {
    add("velocity", j + 1,
        fmt::format("{0}{2} does not go with {1}{2} but with {1}{3} (correlation {4:.2f}): are "
                    "columns swapped?",
                    upper_name_, lower_name_, j + 1, other + 1, most));
  } else {
    add("velocity", j + 1,
        fmt::format("{0}{2} does not go with {1}{2} (correlation {3:.2f}): another joint's, or "
                    "another unit?",
                    upper_name_, lower_name_, j + 1, verdict.here.correlation));
  }
  return {};
}

/// What a factor looks like; empty: nothing that is known.
std::string DerivativeCheck::meaning(double slope) const {
  constexpr double kPerCent = 0.02;
  const auto is = [&](double factor) {
    return std::abs(std::abs(slope) / factor - 1) < kPerCent;
  };
  constexpr double kDegrees = 180 / std::numbers::pi, kPerMinute = 30 / std::numbers::pi;
  const bool turned = slope < 0;
  std::string unit;
  if (is(1)) {
    return turned ? "the sign is turned" : "";
  }
  if (is(kDegrees)) unit = "it looks like deg/s";
  if (is(1 / kDegrees)) unit = "the position looks like degrees";
  if (is(kPerMinute)) unit = "it looks like rpm";
  if (is(1000)) unit = "it looks like thousandths (mrad/s, mm/s)";
  if (is(1 / (2 * std::numbers::pi))) unit = "it looks like turns per second";
  if (!unit.empty() && turned) unit += ", and the sign is turned";
  return unit;
}

/// One factor of all joints is a unit or the rate of time; factors of their own are gears and signs.
void DerivativeCheck::judge_scales(const std::vector<std::pair<Index, Verdict>>& all) {
  const auto is_off = [](const Verdict& verdict) {
    return std::abs(verdict.best.slope - 1) > kDerivativeScale;
  };
  constexpr double kAlike = 0.03;
  const bool alike =
      all.size() > 1 && std::all_of(all.begin(), all.end(), [&](const auto& one) {
        return is_off(one.second) &&
               std::abs(one.second.best.slope / all.front().second.best.slope - 1) < kAlike;
      });
  if (alike) {
    const double slope = all.front().second.best.slope;
    const std::string known = meaning(slope);
    add("velocity", 0,
        fmt::format("{0} of all joints that move is {2:.4g} times what {1} and time say: {3}",
                    upper_name_, lower_name_, slope,
                    !known.empty() ? known
                                   : fmt::format("is a sample taken every {:.4g} ms, not {:.4g} ms "
                                                 "(sampling rate), or is it another unit?",
                                                 1e3 * sample_time_ / std::abs(slope),
                                                 1e3 * sample_time_)));
    return;
  }
  for (const auto& [j, verdict] : all) {
    if (!is_off(verdict)) continue;
    const std::string known = meaning(verdict.best.slope);
    add("velocity", j + 1,
        fmt::format("{0}{2} is {3:.4g} times what {1}{2} and time say: {4}", upper_name_,
                    lower_name_, j + 1, verdict.best.slope,
                    known.empty() ? "unit, sign, gear or sampling rate?" : known));
  }
}

void DerivativeCheck::judge_lag(Index j, const Verdict& verdict) {
  // a lag that matters: what is left of velocities is a hundredth of them
  constexpr double kUnlike = 5e-5;
  const double unlike = 1 - verdict.here.correlation / verdict.best.correlation;
  if (std::abs(verdict.lag) < 2 || !(unlike > kUnlike)) return;
  add("lag", j + 1,
      fmt::format("{0}{2} {3} {1}{2} by {4:.3g} ms", upper_name_, lower_name_, j + 1,
                  verdict.lag > 0 ? "lags behind" : "is ahead of",
                  1e3 * sample_time_ * static_cast<double>(std::abs(verdict.lag))));
}

}  // namespace

std::vector<DerivativeFit> derivative_fits(const Recording& recording, const MatrixXd& lower,
                                           const MatrixXd& upper, double sample_time) {
  std::vector<Remark> none;
  return DerivativeCheck(recording, lower, upper, "", "", sample_time, none).fits();
}

std::vector<Remark> derivative_remarks(const Recording& recording, double sample_time) {
  std::vector<Remark> remarks;
  if (!(sample_time > 0) || recording.samples() < 2) return remarks;
  if (recording.dq.cols() > 0) {
    DerivativeCheck(recording, recording.q, recording.dq, "q", "qd", sample_time, remarks).run();
  }
  if (recording.ddq.cols() == 0) return remarks;
  const bool trusted = recording.dq.cols() > 0 && remarks.empty();
  if (trusted) {
    DerivativeCheck(recording, recording.dq, recording.ddq, "qd", "qdd", sample_time, remarks)
        .run();
    return remarks;
  }
  // slopes of positions stand for velocities that are absent or wrong
  MatrixXd slopes = MatrixXd::Zero(recording.samples(), recording.q.cols());
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run], end = run_end(recording, run);
    for (Index k = first; k < end; ++k) {
      const Index before = std::max(first, k - kNarrowest), after = std::min(end - 1, k + kNarrowest);
      if (after > before) {
        slopes.row(k) = (recording.q.row(after) - recording.q.row(before)) /
                        (recording.time[after] - recording.time[before]);
      }
    }
  }
  DerivativeCheck(recording, slopes, recording.ddq, "the slope of q", "qdd", sample_time, remarks)
      .run();
  return remarks;
}

}  // namespace dyngen::runtime
