// SPDX-License-Identifier: MIT
// The figures of docs/howto/excitation.md: excitation_study conditions | thesis | estimates | names
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "tests/studies/alias_figures.h"
#include "tests/studies/excitation_claims.h"

namespace dyngen::test {
namespace {

using runtime::Criterion;
using runtime::TrajectoryForm;

void print_conditions() {
  fmt::print(
      "| robot | columns | form | random, median (best of 20) | optimised | columns of length 1 | "
      "largest share of a limit | time [s] | evaluations |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const char* robot : {"robots/panda.robot", "robots/ur10e.robot"}) {
    for (const bool inertial_only : {true, false}) {
      for (const TrajectoryForm form : {TrajectoryForm::kFourier, TrajectoryForm::kSpline}) {
        ConditionStudy study{.robot = robot, .inertial_only = inertial_only};
        study.options.family.form = form;
        study.options.starts = 5;
        const ConditionFigures figures = condition_figures(study);
        fmt::print(
            "| {} | {} {} | {} | {:.1f} ({:.1f}) | {:.2f} | {:.2f} | {:.4f} | {:.1f} | {} |\n",
            robot, figures.parameters, inertial_only ? "inertial" : "all",
            form == TrajectoryForm::kFourier ? "Fourier" : "spline", figures.random_median,
            figures.random_best, figures.optimised, figures.unit_columns, figures.shares.largest(),
            figures.seconds, figures.evaluations);
        std::fflush(stdout);
      }
    }
  }
}

void print_thesis() {
  const ThesisArm arm = thesis_arm();
  fmt::print(
      "| seed | 1/sigma at the start | after 15 iterations | after 1500 | factor | largest share "
      "of "
      "a limit | factor without the two changes |\n|---|---|---|---|---|---|---|\n");
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const runtime::HeldAccelerations start = runtime::through_chosen_points(
        arm.robot.linear, arm.limits, arm.parameters, {.seed = seed});
    runtime::MultistageOptions options{.parameters = arm.parameters, .iterations = 1500};
    const runtime::MultistageResult result =
        runtime::multistage(arm.robot.linear, arm.limits, start, options);
    options.barrier_share = 0;
    options.power = std::numeric_limits<double>::infinity();
    const runtime::MultistageResult plain =
        runtime::multistage(arm.robot.linear, arm.limits, start, options);
    fmt::print("| {} | {:.4g} | {:.4g} | {:.4g} | {:.1f} | {:.3f} | {:.1f} ({} steps, {}) |\n",
               seed, result.cost.front(), result.cost.at(15), result.cost.back(),
               result.cost.front() / result.cost.back(), result.shares.largest(),
               plain.cost.front() / plain.cost.back(), plain.cost.size() - 1, plain.ended);
  }
}

void print_estimates() {
  fmt::print(
      "| robot | criterion | random / optimised, median | least | largest | rms / foretold, median "
      "|\n|---|---|---|---|---|---|\n");
  for (const std::string& robot : study_robot_names()) {
    for (const Criterion criterion :
         {Criterion::kCondition, Criterion::kDeterminant, Criterion::kTrace}) {
      EstimateStudy study{.robot = robot};
      study.options.criterion.criterion = criterion;
      const EstimateComparison comparison = compare_estimates(study);
      const Eigen::ArrayXd ratios =
          comparison.random_rms.array() / comparison.optimised_rms.array();
      Eigen::ArrayXd foretold = comparison.optimised_rms.array() / comparison.predicted.array();
      std::sort(foretold.begin(), foretold.end());
      fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} |\n", robot,
                 criterion == Criterion::kCondition     ? "condition"
                 : criterion == Criterion::kDeterminant ? "d"
                                                        : "a",
                 comparison.median_ratio(), ratios.minCoeff(), ratios.maxCoeff(),
                 foretold[foretold.size() / 2]);
      std::fflush(stdout);
    }
  }
}

void print_names() {
  fmt::print(
      "| effect | noise [N m] | second recording [s] | several names, of seeds | wrong one first | "
      "true name alone after "
      "the designed motion | after another one like the first | separation, designed / random |\n"
      "|---|---|---|---|---|---|---|---|\n");
  const AliasCase cases[] = {
      {.effect = "effect stribeck joint=2 Fs=10 vs=0.1 delta=2",
       .family = "stribeck",
       .noise = 0.9},
      {.effect = "effect stribeck joint=2 Fs=10 vs=0.1 delta=2",
       .family = "stribeck",
       .noise = 0.9,
       .next = 8},
      {.effect = "effect torque_saturation joint=2 c=5e-6",
       .family = "torque_saturation",
       .noise = 1.1},
      {.effect = "effect load_friction joint=3 mu=0.03",
       .family = "load_friction",
       .noise = 0.4,
       .size = 0.4},
      {.effect = "effect joint_elasticity joint=2 c=1e-4",
       .family = "joint_elasticity",
       .noise = 0.3,
       .size = 0.8},
  };
  for (const AliasCase& asked : cases) {
    const AliasFigures figures = alias_figures(asked);
    fmt::print("| `{}` | {} | {} | {} of {} | {} | {} | {} | {:.2g} |\n", asked.effect, asked.noise,
               asked.next, figures.several, asked.seeds, figures.wrong_first, figures.designed,
               figures.another, figures.median_gain);
    std::fflush(stdout);
  }
}

int run(int argc, char** argv) {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "conditions") {
    print_conditions();
  } else if (what == "thesis") {
    print_thesis();
  } else if (what == "estimates") {
    print_estimates();
  } else if (what == "names") {
    print_names();
  } else {
    fmt::print(stderr, "usage: excitation_study conditions|thesis|estimates|names\n");
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace dyngen::test

int main(int argc, char** argv) {
  try {
    return dyngen::test::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "excitation_study: {}\n", error.what());
    return 1;
  }
}
