// SPDX-License-Identifier: MIT
#include "runtime/excitation/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "runtime/excitation/constrained_minimum.h"
#include "runtime/excitation/search_budget.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How hard the edges of limits and of the criterion are.
struct Sharpness {
  double power = 2;  ///< of the criterion
  double constraint = 60;
  double factor = 1;  ///< of the limits
};

/// The trajectory's parameters, each in its unit, as one vector.
class Problem {
 public:
  Problem(const LinearModel& model, const MotionLimits& limits, const ExcitationOptions& options)
      : model_(model),
        limits_(limits),
        options_(options),
        basis_(basis_at(options.family, sought_times(options.family))),
        units_(parameter_units(basis_, limits)) {}

  [[nodiscard]] VectorXd from_parameters(const MatrixXd& x) const {
    const MatrixXd y = x.cwiseQuotient(units_);
    return Eigen::Map<const VectorXd>(y.data(), y.size());
  }
  [[nodiscard]] MatrixXd parameters(const VectorXd& y) const {
    return units_.cwiseProduct(Eigen::Map<const MatrixXd>(y.data(), units_.rows(), units_.cols()));
  }
  [[nodiscard]] JointMotion motion(const VectorXd& y) const { return basis_.motion(parameters(y)); }

  [[nodiscard]] SmoothPoint at(const VectorXd& y, const Sharpness& sharpness) const {
    const JointMotion motion = this->motion(y);
    const Information information = information_of(model_, motion, options_.information);
    CriterionOptions criterion = options_.criterion;
    criterion.power = sharpness.power;
    const CriterionValue value = evaluate(information.R, criterion);
    SmoothPoint point;
    point.value = value.value;
    point.gradient = VectorXd::Zero(y.size());
    if (std::isfinite(value.value)) {
      point.gradient = gradient(
          information_gradient(model_, motion, options_.information, information, value.gradient));
    }
    const MotionConstraints constraints =
        constraints_of(model_, limits_, motion, sharpness.constraint, sharpness.factor);
    point.constraints = constraints.values;
    point.jacobian.resize(constraints.values.size(), y.size());
    for (Index c = 0; c < constraints.values.size(); ++c) {
      point.jacobian.row(c) =
          gradient(constraints.by_motion[static_cast<std::size_t>(c)]).transpose();
    }
    return point;
  }

  /// log of the condition number, or what else the criterion is, without the smoothing.
  [[nodiscard]] double sharp_value(const VectorXd& y) const {
    CriterionOptions criterion = options_.criterion;
    criterion.power = 1e4;
    return evaluate(information_of(model_, motion(y), options_.information).R, criterion).value;
  }

  [[nodiscard]] double condition(const VectorXd& y) const {
    return condition_number(model_, motion(y), options_.information.parameters);
  }

 private:
  [[nodiscard]] VectorXd gradient(const JointMotion& by_motion) const {
    MatrixXd by_x = MatrixXd::Zero(units_.rows(), units_.cols());
    if (by_motion.q.size() > 0) by_x += basis_.Q.transpose() * by_motion.q;
    if (by_motion.dq.size() > 0) by_x += basis_.dQ.transpose() * by_motion.dq;
    if (by_motion.ddq.size() > 0) by_x += basis_.ddQ.transpose() * by_motion.ddq;
    by_x = by_x.cwiseProduct(units_);
    return Eigen::Map<const VectorXd>(by_x.data(), by_x.size());
  }

  const LinearModel& model_;
  const MotionLimits& limits_;
  const ExcitationOptions& options_;
  TrajectoryBasis basis_;
  MatrixXd units_;
};

MinimumOptions minimum_options(const SearchBudget::Part& part) {
  MinimumOptions options;
  options.evaluations = part.evaluations;
  options.seconds = part.seconds;
  return options;
}

VectorXd minimise(const Problem& problem, const VectorXd& start, const Sharpness& sharpness,
                  const MinimumOptions& part, SearchBudget& budget) {
  const Minimum minimum =
      constrained_minimum([&](const VectorXd& y) { return problem.at(y, sharpness); }, start, part);
  budget.use(minimum.evaluations);
  return minimum.x;
}

class MotionSearch {
 public:
  MotionSearch(const LinearModel& model, const MotionLimits& limits,
               const ExcitationOptions& options)
      : model_(model),
        limits_(limits),
        options_(options),
        problem_(model, limits, options),
        budget_(options.evaluations, options.seconds) {}

  Excitation run() {
    std::vector<Candidate> candidates;
    for (int i = 0; i < options_.starts; ++i) {
      const VectorXd y = from_start(i);
      if (y.size() > 0) candidates.push_back({y, problem_.sharp_value(y)});
    }
    if (candidates.empty()) {
      result_.message =
          "no random trajectory keeps the limits of torque and the box, however small its motion";
      return std::move(result_);
    }
    std::stable_sort(candidates.begin(), candidates.end(), better);
    candidates.resize(std::min(candidates.size(), kFinalists));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      tell(fmt::format("the best {}", candidates.size()), options_.starts + static_cast<int>(i));
      sharpen(candidates[i], static_cast<double>(candidates.size()));
    }
    prove(std::min_element(candidates.begin(), candidates.end(), better)->y);
    result_.evaluations = budget_.used();
    return std::move(result_);
  }

 private:
  static constexpr double kPartOfStarts = 0.5, kPartOfFinalists = 0.4, kPartOfRound = 0.02;
  static constexpr std::size_t kFinalists = 3;

  struct Candidate {
    VectorXd y;
    double value = 0;  ///< of the criterion, without its smoothing
  };
  static bool better(const Candidate& a, const Candidate& b) { return a.value < b.value; }

  void tell(const std::string& what, int place) const {
    if (options_.progress) {
      options_.progress(what, static_cast<std::size_t>(place),
                        static_cast<std::size_t>(options_.starts + 4));
    }
  }

  VectorXd from_start(int i) {
    tell(fmt::format("start {} of {}", i + 1, options_.starts), i);
    ExcitationStart start{.seed = options_.seed + static_cast<std::uint64_t>(i)};
    const MatrixXd x = random_trajectory(model_, limits_, options_.family, start.seed);
    if (x.size() == 0) return {};
    if (result_.random.size() == 0) result_.random = x;
    VectorXd y = problem_.from_parameters(x);
    start.random = problem_.condition(y);
    // soft limits are tighter: the search begins within them
    constexpr double kRoom = 0.85, kSoftSlack = 0.02;
    y = problem_.from_parameters(shrunk(x, kRoom));
    const double share = kPartOfStarts / options_.starts;
    MinimumOptions first = minimum_options(budget_.of_all(0.4 * share)),
                   second = minimum_options(budget_.of_all(0.6 * share));
    first.violation = second.violation = kSoftSlack;
    y = minimise(problem_, y, {.power = 1, .constraint = 40}, first, budget_);
    y = minimise(problem_, y, {.power = 4, .constraint = 100}, second, budget_);
    start.optimised = problem_.condition(y);
    result_.starts.push_back(start);
    return y;
  }

  /// Harder and harder edges.
  void sharpen(Candidate& candidate, double finalists) {
    const std::array<double, 3> powers = {8, 16, kHardest};
    const double share = kPartOfFinalists / (finalists * powers.size());
    for (const double power : powers) {
      MinimumOptions part = minimum_options(budget_.of_all(share));
      part.tolerance = 1e-5;
      candidate.y = minimise(problem_, candidate.y, edges(power), part, budget_);
    }
    candidate.value = problem_.sharp_value(candidate.y);
    // what would have to be made smaller is not worth its value
    constexpr double kSlack = 0.02;
    const JointMotion motion = problem_.motion(candidate.y);
    if (limit_shares(model_, limits_, motion).largest() > 1 + kSlack) candidate.value += 100;
  }

  static constexpr double kHardest = 40;
  static Sharpness edges(double power) { return {.power = power, .constraint = 40 * power}; }

  /// Checks at the check rate; where a limit is passed, tighter limits.
  void prove(VectorXd y) {
    Sharpness sharpness = edges(kHardest);
    constexpr int kRounds = 5;
    double share = 0;
    for (int round = 0; round < kRounds; ++round) {
      tell("the limits between instants", options_.starts + static_cast<int>(kFinalists));
      share = check(problem_.parameters(y));
      if (share <= 1) return;
      sharpness.factor *= 0.9995 / share;
      y = minimise(problem_, y, sharpness, minimum_options(budget_.of_all(kPartOfRound)), budget_);
    }
    MatrixXd x = problem_.parameters(y);
    constexpr int kShrinks = 60;
    for (int k = 0; k < kShrinks; ++k) {
      share = check(x);
      if (share <= 1) return;
      x = shrunk(x, std::min(0.995, 0.9995 / share));
    }
    result_.message = fmt::format(
        "the largest share of a limit is {:.4f} and does not fall when the motion gets "
        "smaller: the arm cannot hold itself there",
        share);
  }

  double check(const MatrixXd& x) {
    result_.x = x;
    result_.shares = shares_at_rate(
        model_, limits_, options_.family.duration,
        [&](const VectorXd& time) { return basis_at(options_.family, time).motion(x); },
        options_.check_rate);
    result_.found = result_.shares.largest() <= 1;
    return result_.shares.largest();
  }

  const LinearModel& model_;
  const MotionLimits& limits_;
  const ExcitationOptions& options_;
  Problem problem_;
  SearchBudget budget_;
  Excitation result_;
};

}  // namespace

void ExcitationOptions::validate() const {
  family.validate();
  criterion.validate();
  if (starts < 1) {
    throw std::invalid_argument(fmt::format("starts: {}, expected at least 1", starts));
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

Excitation excite(const LinearModel& model, const MotionLimits& limits,
                  const ExcitationOptions& options) {
  options.validate();
  options.information.validate(model);
  limits.validate(model);
  return MotionSearch(model, limits, options).run();
}

}  // namespace dyngen::runtime
