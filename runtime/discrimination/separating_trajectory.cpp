// SPDX-License-Identifier: MIT
#include "runtime/discrimination/separating_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/discrimination/archetype_motions.h"
#include "runtime/discrimination/free_maximum.h"
#include "runtime/excitation/limited_trajectory.h"
#include "runtime/excitation/search_budget.h"
#include "runtime/excitation/trajectory_basis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRoom = 0.999;  // of the limits, since rounding may pass what is held exactly
constexpr int kRandomMotions = 5;
constexpr double kNothing = 1e-9;  // chi-square that is rounding

/// All limits of a motion, made smaller. Torque and box stay: motions do not know of them.
MotionLimits tightened(MotionLimits limits, double factor) {
  const VectorXd middle = 0.5 * (limits.lower + limits.upper);
  limits.lower = middle + factor * (limits.lower - middle);
  limits.upper = middle + factor * (limits.upper - middle);
  limits.speed *= factor;
  limits.acceleration *= factor;
  return limits;
}

class Designer {
 public:
  Designer(const SeparationProblem& problem, const MotionLimits& limits,
           const SeparatingOptions& options, const PlannedMotion& usual)
      : limits_(limits),
        within_(tightened(limits, kRoom)),
        options_(options),
        criterion_(problem, usual),
        motions_(archetype_motions(limits, problem.finding.joint, options.duration, options.seed)),
        budget_(options.evaluations, options.seconds) {}

  SeparatingTrajectory run() {
    result_.left_out = criterion_.left_out();
    judge_random();
    std::vector<Candidate> best = first_look();
    if (best.empty()) {
      result_.message =
          "no motion of any archetype keeps the limits of torque and the box, however small";
      return std::move(result_);
    }
    best.resize(std::min(best.size(), kFinalists));
    for (std::size_t i = 0; i < best.size(); ++i) {
      tell("the best " + std::to_string(best.size()), i, best.size());
      refine(best[i], 1.0 / static_cast<double>(best.size() - i));
    }
    conclude(*std::max_element(best.begin(), best.end(), better));
    result_.evaluations = budget_.used();
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kFinalists = 3;

  struct Candidate {
    std::size_t motion = 0;
    VectorXd x;
    double value = 0;  ///< log of the least separation
  };
  static bool better(const Candidate& a, const Candidate& b) { return a.value < b.value; }

  void tell(const std::string& what, std::size_t place, std::size_t all) const {
    if (options_.progress) options_.progress(what, place, all);
  }

  [[nodiscard]] const LinearModel& model() const { return criterion_.problem().model; }

  /// Not above 1 where torque and box are kept, at the rate of the criterion.
  [[nodiscard]] double other_limits(const PlannedMotion& motion) const {
    if (!limits_.limits_torque() && !limits_.box) return 0;
    const double rate = std::min(criterion_.problem().rate, criterion_.problem().looked_at);
    return shares_at_rate(model(), limits_, motion.duration, motion.at, rate).largest();
  }

  double value(std::size_t place, const VectorXd& x) {
    constexpr double kRefused = -1000;
    budget_.use(1);
    const PlannedMotion motion = motions_[place].motion(x, within_);
    const double share = other_limits(motion);
    if (share > 1) return kRefused - share;
    return std::log(std::max(criterion_.at(motion).least, kNothing));
  }
  static bool kept(double value) { return value > -1000; }

  void judge_random() {
    struct Judged {
      std::uint64_t seed = 0;
      double least = 0;
    };
    std::vector<Judged> judged;
    for (int i = 0; i < kRandomMotions; ++i) {
      const std::uint64_t seed = options_.seed + static_cast<std::uint64_t>(i);
      tell("random motions", static_cast<std::size_t>(i), kRandomMotions);
      const PlannedMotion motion = random_motion(model(), limits_, options_.duration, seed);
      if (motion.duration > 0) judged.push_back({seed, criterion_.at(motion).least});
    }
    if (judged.empty()) return;
    std::stable_sort(judged.begin(), judged.end(),
                     [](const Judged& a, const Judged& b) { return a.least < b.least; });
    result_.random_seed = judged[judged.size() / 2].seed;
    result_.random = criterion_.finely_at(
        random_motion(model(), limits_, options_.duration, result_.random_seed));
  }

  /// The best start of every archetype that keeps the limits, the best archetype first.
  std::vector<Candidate> first_look() {
    std::vector<Candidate> best;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      tell("archetypes", i, motions_.size());
      // at least one of everything, whatever the clock says
      Candidate own = within_torque({i, motions_[i].start, 0});
      if (!kept(own.value)) continue;
      const auto same = std::find_if(best.begin(), best.end(), [&](const Candidate& other) {
        return motions_[other.motion].archetype == motions_[i].archetype;
      });
      if (same == best.end()) {
        best.push_back(std::move(own));
      } else if (better(*same, own)) {
        *same = std::move(own);
      }
    }
    std::stable_sort(best.begin(), best.end(),
                     [](const Candidate& a, const Candidate& b) { return better(b, a); });
    for (const Candidate& own : best) {
      result_.scores.push_back(
          {motions_[own.motion].archetype, motions_[own.motion].joint, std::exp(own.value)});
    }
    return best;
  }

  /// Where torque or box refuse a start, all its numbers but the postures are made smaller.
  Candidate within_torque(Candidate own) {
    constexpr int kShrinks = 4;
    constexpr double kShrink = 0.7;
    own.value = value(own.motion, own.x);
    for (int i = 0; i < kShrinks && !kept(own.value); ++i) {
      own.x = motions_[own.motion].smaller(own.x, kShrink);
      own.value = value(own.motion, own.x);
    }
    return own;
  }

  void refine(Candidate& own, double share) {
    if (budget_.spent()) return;
    const SearchBudget::Part part = budget_.of_rest(share);
    FreeMaximumOptions options;
    options.evaluations = part.evaluations;
    options.seconds = part.seconds;
    const FreeMaximum found =
        free_maximum([&](const VectorXd& x) { return value(own.motion, x); }, own.x, options);
    if (found.value <= own.value) return;
    own.x = found.x;
    own.value = found.value;
  }

  /// The motion, in limits that are made tighter until the check rate finds them kept.
  void conclude(const Candidate& own) {
    constexpr int kRounds = 12;
    double factor = kRoom;
    tell("the limits between instants", 0, 1);
    result_.archetype = motions_[own.motion].archetype;
    result_.joint = motions_[own.motion].joint;
    double share = 0;
    for (int round = 0; round < kRounds; ++round) {
      result_.motion = motions_[own.motion].motion(own.x, tightened(limits_, factor));
      result_.shares = shares_at_rate(model(), limits_, result_.motion.duration, result_.motion.at,
                                      options_.check_rate);
      share = result_.shares.largest();
      result_.found = share <= 1;
      if (result_.found) break;
      factor *= std::min(0.999, 0.999 / share);
    }
    if (!result_.found) {
      result_.message = fmt::format(
          "the largest share of a limit is {:.4f} and does not fall when the motion gets smaller",
          share);
      return;
    }
    result_.separation = criterion_.finely_at(result_.motion);
    if (result_.separation.least > kNothing) return;
    result_.found = false;
    result_.message =
        "no motion tells them apart: a rival has the same columns as the finding on all that were "
        "tried";
  }

  const MotionLimits& limits_;
  MotionLimits within_;
  const SeparatingOptions& options_;
  SeparationCriterion criterion_;
  std::vector<ArchetypeMotion> motions_;
  SearchBudget budget_;
  SeparatingTrajectory result_;
};

}  // namespace

void SeparatingOptions::validate() const {
  if (!(duration > 0) || !std::isfinite(duration)) {
    throw std::invalid_argument(fmt::format("duration: {} s, expected more than 0", duration));
  }
  if (evaluations < 0) {
    throw std::invalid_argument(fmt::format("evaluations: {}, expected 0 or more", evaluations));
  }
  if (!(seconds > 0)) {
    throw std::invalid_argument(fmt::format("seconds: {}, expected more than 0", seconds));
  }
  if (!(check_rate > 0)) {
    throw std::invalid_argument(fmt::format("check rate: {}, expected more than 0", check_rate));
  }
}

PlannedMotion random_motion(const LinearModel& model, const MotionLimits& limits, double duration,
                            std::uint64_t seed) {
  const TrajectoryFamily family{
      .form = TrajectoryForm::kFourier, .duration = duration, .harmonics = 5};
  const Eigen::MatrixXd x = random_trajectory(model, limits, family, seed);
  if (x.size() == 0) return {};
  return {duration, [family, x](const VectorXd& time) { return basis_at(family, time).motion(x); }};
}

SeparatingTrajectory separate(const SeparationProblem& problem, const MotionLimits& limits,
                              const SeparatingOptions& options) {
  options.validate();
  problem.validate();
  limits.validate(problem.model);
  // sizes and speeds that are usual within the limits of motion, whatever torque it takes
  MotionLimits free = limits;
  free.torque.setConstant(std::numeric_limits<double>::infinity());
  free.box.reset();
  const PlannedMotion usual = random_motion(problem.model, free, options.duration, options.seed);
  return Designer(problem, limits, options, usual).run();
}

}  // namespace dyngen::runtime
