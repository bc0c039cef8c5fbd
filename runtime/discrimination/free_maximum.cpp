// SPDX-License-Identifier: MIT
#include "runtime/discrimination/free_maximum.h"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Between the solver, which is C, and the function.
struct FreeSearch {
  const std::function<double(const VectorXd&)>& value;
  FreeMaximum best;
  nlopt_opt solver = nullptr;
  std::exception_ptr failure;

  void look_at(const VectorXd& x, double found) {
    ++best.evaluations;
    if (best.x.size() > 0 && !(found > best.value)) return;
    best.x = x;
    best.value = found;
  }
};

double asked(unsigned size, const double* x, double* /*gradient*/, void* data) {
  FreeSearch& search = *static_cast<FreeSearch*>(data);
  const VectorXd point = Eigen::Map<const VectorXd>(x, static_cast<Index>(size));
  try {
    const double found = search.value(point);
    search.look_at(point, found);
    return found;
  } catch (...) {
    search.failure = std::current_exception();
    nlopt_force_stop(search.solver);
    return search.best.value;
  }
}

}  // namespace

FreeMaximum free_maximum(const std::function<double(const VectorXd&)>& value, const VectorXd& start,
                         const FreeMaximumOptions& options) {
  FreeSearch search{value, {}, nullptr, nullptr};
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> solver(
      nlopt_create(NLOPT_LN_SBPLX, static_cast<unsigned>(start.size())), nlopt_destroy);
  if (!solver) throw std::runtime_error("NLopt cannot make a Subplex solver");
  search.solver = solver.get();
  nlopt_set_max_objective(solver.get(), asked, &search);
  nlopt_set_lower_bounds1(solver.get(), 0);
  nlopt_set_upper_bounds1(solver.get(), 1);
  nlopt_set_initial_step1(solver.get(), options.first_step);
  nlopt_set_xtol_abs1(solver.get(), options.tolerance);
  if (options.evaluations > 0) nlopt_set_maxeval(solver.get(), options.evaluations);
  nlopt_set_maxtime(solver.get(), options.seconds);
  VectorXd x = start.cwiseMax(0).cwiseMin(1);
  double found = 0;
  // what it returns says only why it ended: the best point is kept here
  nlopt_optimize(solver.get(), x.data(), &found);
  if (search.failure) std::rethrow_exception(search.failure);
  if (search.best.x.size() == 0) throw std::runtime_error("NLopt refused to begin");
  return search.best;
}

}  // namespace dyngen::runtime
