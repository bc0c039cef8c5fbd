// SPDX-License-Identifier: MIT
#include "runtime/excitation/constrained_minimum.h"

#include <nlopt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What is not defined, to a solver that wants a number.
constexpr double kVeryLarge = 1e6;

/// Between the solver, which asks for values and constraints apart, and the function.
class Search {
 public:
  Search(const std::function<SmoothPoint(const VectorXd&)>& at, const MinimumOptions& options)
      : at_(at), options_(options) {}

  const SmoothPoint& point(const double* x, unsigned size) {
    const Eigen::Map<const VectorXd> asked(x, static_cast<Index>(size));
    if (x_.size() == asked.size() && x_ == asked) return point_;
    x_ = asked;
    point_ = at_(x_);
    ++best_.evaluations;
    keep_if_better();
    return point_;
  }

  [[nodiscard]] const Minimum& best() const { return best_; }
  [[nodiscard]] double scale() const { return options_.first_step; }

 private:
  void keep_if_better() {
    const double violation =
        point_.constraints.size() == 0 ? 0 : std::max(0.0, point_.constraints.maxCoeff());
    const bool keeps = violation <= options_.violation;
    const bool best_keeps = best_.violation <= options_.violation;
    const bool better = best_.x.size() == 0   ? true
                        : keeps && best_keeps ? point_.value < best_.value
                        : keeps != best_keeps ? keeps
                                              : violation < best_.violation;
    if (!better) return;
    best_.x = x_;
    best_.value = point_.value;
    best_.violation = violation;
  }

  const std::function<SmoothPoint(const VectorXd&)>& at_;
  const MinimumOptions& options_;
  VectorXd x_;
  SmoothPoint point_;
  Minimum best_;
};

double objective(unsigned size, const double* x, double* gradient, void* search) {
  Search& own = *static_cast<Search*>(search);
  const SmoothPoint& point = own.point(x, size);
  const bool defined = std::isfinite(point.value);
  if (gradient != nullptr) {
    Eigen::Map<VectorXd> g(gradient, static_cast<Index>(size));
    if (defined) {
      g = own.scale() * point.gradient;
    } else {
      g.setZero();
    }
  }
  return defined ? own.scale() * point.value : kVeryLarge;
}

void constraints(unsigned count, double* values, unsigned size, const double* x, double* gradient,
                 void* search) {
  const SmoothPoint& point = static_cast<Search*>(search)->point(x, size);
  Eigen::Map<VectorXd>(values, static_cast<Index>(count)) = point.constraints;
  if (gradient == nullptr) return;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(gradient, static_cast<Index>(count), static_cast<Index>(size)) =
      point.jacobian;
}

}  // namespace

Minimum constrained_minimum(const std::function<SmoothPoint(const VectorXd&)>& at,
                            const VectorXd& start, const MinimumOptions& options) {
  Search search(at, options);
  const unsigned size = static_cast<unsigned>(start.size());
  const Index count = search.point(start.data(), size).constraints.size();
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> solver(
      nlopt_create(NLOPT_LD_SLSQP, size), nlopt_destroy);
  if (!solver) throw std::runtime_error("constrained_minimum(): NLopt has no SLSQP");
  nlopt_set_min_objective(solver.get(), objective, &search);
  const VectorXd tolerances = VectorXd::Constant(count, options.violation);
  if (count > 0) {
    nlopt_add_inequality_mconstraint(solver.get(), static_cast<unsigned>(count), constraints,
                                     &search, tolerances.data());
  }
  nlopt_set_ftol_abs(solver.get(), options.first_step * options.tolerance);
  const auto begin = std::chrono::steady_clock::now();
  // It ends early where its model of the curvature has gone wrong: then it begins again from the
  // best point that was seen, with a new one.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
    const int left = options.evaluations - search.best().evaluations;
    if (left < 2 || gone.count() >= options.seconds) break;
    nlopt_set_maxeval(solver.get(), left);
    nlopt_set_maxtime(solver.get(), options.seconds - gone.count());
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the search changes its best
    const Minimum before = search.best();
    VectorXd x = before.x;
    double value = 0;
    nlopt_optimize(solver.get(), x.data(), &value);
    const Minimum& after = search.best();
    const bool keeps = after.violation <= options.violation;
    const bool newly = keeps && before.violation > options.violation;
    const double gain = keeps ? before.value - after.value : before.violation - after.violation;
    if (!newly && !(gain > 10 * options.tolerance)) break;
  }
  return search.best();
}

}  // namespace dyngen::runtime
