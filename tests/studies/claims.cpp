// SPDX-License-Identifier: MIT
#include "tests/studies/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/significance.h"
#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::Estimate;
using runtime::FitMethod;
using runtime::RowBlock;
using runtime::Significance;
using runtime::TorqueFactor;

namespace {

/// One recording with what the claims ask of it.
struct Case {
  StudyData data;
  Estimate wls;
  [[nodiscard]] const TorqueFactor& equations() const { return data.data.summary.equations; }
};

std::vector<Case> cases_of(const StudyRobot& robot, const StudyPlan& plan) {
  std::vector<Case> cases;
  for (unsigned r = 0; r < static_cast<unsigned>(plan.repetitions); ++r) {
    const unsigned seed = plan.first_seed + r;
    const FourierMotion motion = study_motion(robot, plan.motion, seed);
    const ClosedLoopRun run = simulate(robot.truth, motion, robot.loop, seed);
    Case one;
    one.data = study_data(robot, run.measured, nullptr);
    one.wls = weighted_least_squares(one.equations());
    cases.push_back(std::move(one));
  }
  return cases;
}

template <typename Function>
double median_over(const std::vector<Case>& cases, const Function& value) {
  std::vector<double> values;
  for (const Case& one : cases) values.push_back(value(one));
  return median(std::move(values));
}

/// Norm of the parameter error with columns of unit norm, over that of the truth.
double parameter_error(const StudyRobot& robot, const Case& one, const VectorXd& beta) {
  const VectorXd norms = column_norms(one.equations(), one.wls.joint_weights);
  return (beta - robot.beta).cwiseProduct(norms).norm() / robot.beta.cwiseProduct(norms).norm();
}

void print_scaling(const std::vector<Case>& cases) {
  const double raw = median_over(cases, [](const Case& one) { return one.wls.raw_condition; });
  const double unit = median_over(cases, [](const Case& one) { return one.wls.condition; });
  const double sensitivity = median_over(cases, [](const Case& one) {
    const VectorXd& weights = one.wls.joint_weights;
    return runtime::condition_number(
        singular_values(one.equations(), weights, sensitivity_scale(one.equations(), weights)));
  });
  fmt::print(
      "| scaling lowers the condition | raw {:.0f}, by torque sensitivity {:.0f}, by the "
      "column's norm {:.0f} |\n",
      raw, sensitivity, unit);
}

template <typename Function>
void print_removal(const StudyRobot& robot, const std::vector<Case>& cases,
                   const HeldoutMotion& heldout, const std::string& claim,
                   const Function& analysis) {
  std::vector<double> before, after, removed, error, plain, distance, plain_distance;
  for (const Case& one : cases) {
    const Significance result = analysis(one);
    before.push_back(result.condition_before);
    after.push_back(result.condition_after);
    removed.push_back(static_cast<double>(result.removed.size()));
    error.push_back(100 * heldout.error(result.estimate.beta));
    plain.push_back(100 * heldout.error(one.wls.beta));
    distance.push_back(100 * parameter_error(robot, one, result.estimate.beta));
    plain_distance.push_back(100 * parameter_error(robot, one, one.wls.beta));
  }
  fmt::print(
      "| {} | condition {:.0f} -> {:.0f}, {:.0f} of {} parameters removed; held-out torque "
      "error {:.2f} % (wls {:.2f} %), parameter error {:.2f} % ({:.2f} %) |\n",
      claim, median(before), median(after), median(removed), robot.described.linear.size(),
      median(error), median(plain), median(distance), median(plain_distance));
}

/// Weakly excited: parameters that wls states with a deviation above 30 % of their value.
void print_weakest(const StudyRobot& robot, const std::vector<Case>& cases,
                   const HeldoutMotion& heldout, const char* excitation) {
  for (const int directions : {-1, 2, 5, 10}) {
    if (directions >= robot.described.linear.size() / 2) continue;
    std::vector<double> dropped, weak, plain_weak, nearer, error, plain;
    for (const Case& one : cases) {
      const VectorXd stddev = white_covariance(one.equations(), one.wls.beta, one.wls.joint_weights,
                                               one.wls.scale, one.wls.unseen)
                                  .diagonal()
                                  .cwiseSqrt();
      const Significance result = drop_weakest(one.equations(), one.wls.joint_weights, directions);
      dropped.push_back(static_cast<double>(robot.beta.size() - result.estimate.rank));
      for (Index i = 0; i < stddev.size(); ++i) {
        if (stddev[i] < 0.3 * std::abs(robot.beta[i])) continue;
        const double size = std::abs(robot.beta[i]);
        if (size == 0) continue;
        const double with = std::abs(result.estimate.beta[i] - robot.beta[i]);
        const double without = std::abs(one.wls.beta[i] - robot.beta[i]);
        weak.push_back(with / size);
        plain_weak.push_back(without / size);
        nearer.push_back(with < without ? 1 : 0);
      }
      error.push_back(100 * heldout.error(result.estimate.beta));
      plain.push_back(100 * heldout.error(one.wls.beta));
    }
    double count = 0;
    for (const double one : nearer) count += one;
    fmt::print(
        "| dropping the weakest directions ({}, {}) | {:.0f} dropped; {:.0f} % of {} weakly "
        "excited parameters are nearer to the truth, median relative error {:.0f} % (wls "
        "{:.0f} %); held-out torque error {:.2f} % ({:.2f} %) |\n",
        excitation, directions < 0 ? std::string("chosen") : fmt::format("{}", directions),
        median(dropped), 100 * count / static_cast<double>(std::max<std::size_t>(1, nearer.size())),
        nearer.size(), 100 * median(weak), 100 * median(plain_weak), median(error), median(plain));
  }
}

void print_ridge(const StudyRobot& robot, const StudyPlan& plan, const std::vector<Case>& cases,
                 const HeldoutMotion& heldout, const char* excitation) {
  struct Setting {
    double real, stated;
  };
  for (const Setting setting :
       {Setting{0.05, 0.05}, Setting{0.2, 0.2}, Setting{1, 1}, Setting{1, 0.05}}) {
    std::vector<double> error[2], distance[2], plain, plain_distance, prior_error;
    for (std::size_t r = 0; r < cases.size(); ++r) {
      const Case& one = cases[r];
      const VectorXd prior =
          prior_of(robot, setting.real, plan.first_seed + static_cast<unsigned>(r) + 5000);
      prior_error.push_back(100 * heldout.error(prior));
      plain.push_back(100 * heldout.error(one.wls.beta));
      plain_distance.push_back(100 * parameter_error(robot, one, one.wls.beta));
      for (const int way : {0, 1}) {
        runtime::FitOptions options;
        options.methods = {FitMethod::kRidge};
        options.prior = prior;
        options.prior_relative = setting.stated;
        options.lambda = way == 0 ? -1 : 1;
        const VectorXd beta =
            fit_methods(robot.described.linear, one.data.data, options).front().estimate.beta;
        error[way].push_back(100 * heldout.error(beta));
        distance[way].push_back(100 * parameter_error(robot, one, beta));
      }
    }
    fmt::print(
        "| ridge, prior off by {:.0f} %, stated {:.0f} % ({}) | held-out torque error {:.2f} "
        "% at the corner, {:.2f} % at lambda 1 (wls {:.2f} %, prior {:.2f} %); parameter "
        "error {:.2f} %, {:.2f} % (wls {:.2f} %) |\n",
        100 * setting.real, 100 * setting.stated, excitation, median(error[0]), median(error[1]),
        median(plain), median(prior_error), median(distance[0]), median(distance[1]),
        median(plain_distance));
  }
}

/// Every sample as generated code would give it: (n x nb) row-major, weighted to unit noise.
struct Samples {
  std::vector<runtime::RowMajorMatrix> Y;
  std::vector<VectorXd> tau;
};
Samples samples_of(const Case& one, Index parameters) {
  Samples samples;
  one.data.data.rows([&](const RowBlock& block) {
    const Index joints = block.tau.cols();
    for (Index k = 0; k < block.tau.rows(); ++k) {
      runtime::RowMajorMatrix Y(joints, parameters);
      for (Index j = 0; j < joints; ++j) {
        Y.row(j) = one.wls.joint_weights[j] * block.Y.row(k).segment(j * parameters, parameters);
      }
      samples.Y.push_back(std::move(Y));
      samples.tau.push_back(block.tau.row(k).transpose().cwiseProduct(one.wls.joint_weights));
    }
  });
  return samples;
}

template <typename Estimator>
double lms_error(Estimator estimator, const Samples& samples, const HeldoutMotion& heldout) {
  constexpr int kPasses = 20;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t k = 0; k < samples.Y.size(); ++k) {
      estimator.update(samples.Y[k].data(), samples.tau[k].data());
    }
  }
  return 100 * heldout.error(estimator.beta());
}

void print_lms(const StudyRobot& robot, const std::vector<Case>& cases,
               const HeldoutMotion& heldout) {
  const Index nb = robot.beta.size();
  const int joints = robot.described.linear.joints();
  for (const bool scaled : {false, true}) {
    for (const double peak : {0.5, 1.9, 10.0}) {
      std::vector<double> plain, mode;
      for (const Case& one : cases) {
        const Samples samples = samples_of(one, nb);
        VectorXd gain = VectorXd::Ones(nb);
        if (scaled) gain = one.wls.scale.cwiseAbs2();
        double strongest = 0;  // largest eigenvalue of Gamma Y'Y over the samples
        for (const auto& Y : samples.Y) {
          strongest = std::max(strongest, runtime::peak_gain(gain, Y, joints));
        }
        gain *= peak / strongest;
        plain.push_back(lms_error(runtime::Lms(joints, {.gain = gain}), samples, heldout));
        mode.push_back(
            lms_error(runtime::ConvergentModeLms(joints, {.gain = gain}), samples, heldout));
      }
      fmt::print(
          "| LMS along the convergent mode, {} gain, peak {:.1f}, 20 passes | held-out torque "
          "error {:.3g} % (plain LMS {:.3g} %) |\n",
          scaled ? "scaled" : "one", peak, median(mode), median(plain));
    }
  }
}

}  // namespace

void print_claims(const StudyRobot& robot, const StudyPlan& plan) {
  const HeldoutMotion heldout = heldout_motion(robot);
  const std::vector<Case> good = cases_of(robot, plan);
  StudyPlan slow = plan;
  slow.motion.amplitude = 0.2;
  const std::vector<Case> poor = cases_of(robot, slow);
  fmt::print(
      "\n### {}: claims of the thesis\n\n{} recordings each, seeds from {}; poor: motion of "
      "{:.0f} % of the amplitude. Medians.\n\n| claim | measured |\n|---|---|\n",
      robot.name, plan.repetitions, plan.first_seed, 100 * slow.motion.amplitude);
  print_scaling(good);
  print_removal(robot, good, heldout, "removing parameters of low sensitivity lowers it",
                [](const Case& one) {
                  return remove_insensitive(one.equations(), one.wls.joint_weights, 0.02);
                });
  for (const double most : {100.0, 30.0}) {
    print_removal(robot, good, heldout,
                  fmt::format("removing near dependencies lowers it (to {:.0f})", most),
                  [most](const Case& one) {
                    return remove_dependent(one.equations(), one.wls.joint_weights, most);
                  });
  }
  print_weakest(robot, good, heldout, "good excitation");
  print_weakest(robot, poor, heldout, "poor excitation");
  print_ridge(robot, plan, good, heldout, "good excitation");
  print_ridge(robot, plan, poor, heldout, "poor excitation");
  print_lms(robot, good, heldout);
}

}  // namespace dyngen::test
