// SPDX-License-Identifier: MIT
#include "tests/studies/method_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

namespace dyngen::test {

using runtime::FitMethod;
using runtime::MotionOptions;
using runtime::StateMethod;

namespace {

const std::vector<FitMethod> kEvery = {
    FitMethod::kLs,  FitMethod::kWls,     FitMethod::kIrls, FitMethod::kRidge,  FitMethod::kSvd,
    FitMethod::kLms, FitMethod::kLmsMode, FitMethod::kRls,  FitMethod::kKalman, FitMethod::kIv};

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean and its standard error over the recordings, in percent: parameters of one recording do not
/// err independently.
std::string share(const std::vector<double>& covered) {
  if (covered.size() < 2) return covered.empty() ? "-" : fmt::format("{:.1f}", 100 * covered[0]);
  const double mean = mean_of(covered);
  double squares = 0;
  for (const double one : covered) squares += (one - mean) * (one - mean);
  const double count = static_cast<double>(covered.size());
  return fmt::format("{:.1f} ± {:.1f}", 100 * mean, 100 * std::sqrt(squares / (count - 1) / count));
}

/// "93.1", or "-" if there is nothing to say.
std::string cell(double value, const char* format) {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

/// In how many recordings iv's test finds noise in the regressor.
std::ptrdiff_t found(const MethodSummary& iv) {
  return std::count_if(iv.p_values.begin(), iv.p_values.end(), [](double p) { return p < 0.05; });
}

std::string row_of(const MethodSummary& method) {
  return fmt::format(
      "| {} | {:.3f} | {:.3f} | {} | {} | {} | {:.0f} |", method.name,
      100 * median(method.torque_errors),
      100 * *std::max_element(method.torque_errors.begin(), method.torque_errors.end()),
      cell(median(method.errors), "{:.2f}"), share(method.covered), share(method.textbook_covered),
      1000 * median(method.seconds));
}

void print_head(const StudyRobot& robot, const StudyPlan& plan, const char* what) {
  fmt::print(
      "\n### {}: {}\n\n{} base parameters; {} recordings of {:.0f} s at {:.0f} Hz, {}; seeds "
      "{} to {}.\n\n",
      robot.name, what, robot.described.linear.size(), plan.repetitions, robot.loop.seconds,
      1 / robot.loop.sample_time,
      plan.motion.repeats ? "two equal periods" : "a motion that does not repeat", plan.first_seed,
      plan.first_seed + static_cast<unsigned>(plan.repetitions) - 1);
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void MethodSummary::add(const MethodScore& score) {
  name = runtime::fit_method_names()[static_cast<std::size_t>(score.method)];
  torque_errors.push_back(score.torque_error);
  errors.insert(errors.end(), score.errors.begin(), score.errors.end());
  if (!std::isnan(score.covered)) covered.push_back(score.covered);
  if (!std::isnan(score.textbook_covered)) textbook_covered.push_back(score.textbook_covered);
  seconds.push_back(score.seconds);
  conditions.push_back(score.condition);
  parameter_errors.push_back(score.parameter_error);
  if (score.p_value >= 0) p_values.push_back(score.p_value);
}

double MethodSummary::coverage() const { return mean_of(covered); }

void print_methods(const StudyRobot& robot, const StudyPlan& plan) {
  const HeldoutMotion heldout = heldout_motion(robot);
  std::vector<MethodSummary> methods(kEvery.size());
  MethodSummary bayes;
  std::vector<double> rows, cutoffs, simulated;
  for (unsigned r = 0; r < static_cast<unsigned>(plan.repetitions); ++r) {
    const unsigned seed = plan.first_seed + r;
    const FourierMotion motion = study_motion(robot, plan.motion, seed);
    const auto start = std::chrono::steady_clock::now();
    const ClosedLoopRun run = simulate(robot.truth, motion, robot.loop, seed);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    simulated.push_back(took.count());
    const StudyData data = study_data(robot, run.measured, &motion);
    rows.push_back(data.data.summary.equations.samples());
    cutoffs.push_back(data.source.cutoff.hz);
    runtime::FitOptions options;
    options.prior_relative = 0.2;
    options.prior = prior_of(robot, options.prior_relative, seed);
    const auto scores = run_methods(robot, data, heldout, kEvery, options);
    for (std::size_t m = 0; m < scores.size(); ++m) methods[m].add(scores[m]);
    options.lambda = 1;
    bayes.add(run_methods(robot, data, heldout, {FitMethod::kRidge}, options).front());
    fmt::print(stderr, "{} {}/{}\n", robot.name, r + 1, plan.repetitions);
  }
  print_head(robot, plan, "methods");
  fmt::print(
      "Medians: {:.0f} equations of each joint, cut-off {:.2f} Hz, condition (unit columns) "
      "{:.0f}, {:.1f} s to simulate a recording. Noise in the regressor is found (iv, p < "
      "0.05) in {} of {}.\n\n",
      median(rows), median(cutoffs), median(methods[1].conditions), median(simulated),
      found(methods.back()), plan.repetitions);
  fmt::print(
      "| method | held-out torque error, median % | worst % | parameter error, median in "
      "stated sigma | covered by 95 % intervals, % | textbook's, % | ms |\n"
      "|---|---|---|---|---|---|---|\n");
  bayes.name = "ridge, lambda 1";
  for (const MethodSummary& method : methods) {
    fmt::print("{}\n", row_of(method));
    if (method.name == "ridge") fmt::print("{}\n", row_of(bayes));
  }
}

void print_causes(const StudyRobot& robot, const StudyPlan& plan) {
  struct Cause {
    const char* name;
    std::function<void(ClosedLoopOptions&, MotionOptions&)> change;
    bool true_states = false;
  };
  const auto recorded = [](ClosedLoopOptions&, MotionOptions& o) {
    o.state.method = StateMethod::kRecorded;
    o.average_periods = false;
  };
  const std::vector<Cause> causes = {
      {"as measured", [](ClosedLoopOptions&, MotionOptions&) {}},
      {"periods not averaged",
       [](ClosedLoopOptions&, MotionOptions& o) { o.average_periods = false; }},
      {"true q, dq, ddq", recorded, true},
      {"true states, white torque noise only",
       [recorded](ClosedLoopOptions& loop, MotionOptions& o) {
         recorded(loop, o);
         loop.coloured_part = 0;
       },
       true},
      {"exact encoder",
       [](ClosedLoopOptions& loop, MotionOptions&) { loop.encoder_step.setZero(); }},
      {"encoder 20 times coarser",
       [](ClosedLoopOptions& loop, MotionOptions&) { loop.encoder_step *= 20; }},
      {"white torque noise only",
       [](ClosedLoopOptions& loop, MotionOptions&) { loop.coloured_part = 0; }},
      {"torque recorded half a sample early",
       [](ClosedLoopOptions& loop, MotionOptions&) { loop.centred_torque = false; }},
      {"cut-off 20 Hz", [](ClosedLoopOptions&, MotionOptions& o) { o.state.cutoff_hz = 20; }},
      {"no torque noise",
       [](ClosedLoopOptions& loop, MotionOptions&) { loop.torque_noise.setZero(); }},
      {"no torque noise, exact encoder",
       [](ClosedLoopOptions& loop, MotionOptions&) {
         loop.torque_noise.setZero();
         loop.encoder_step.setZero();
       }},
  };
  const HeldoutMotion heldout = heldout_motion(robot);
  print_head(robot, plan, "what the misses come from");
  fmt::print(
      "| recording | ls covered, % | textbook's | wls covered, % | textbook's | iv covered, "
      "% | wls error, median in sigma | wls torque error, median % | iv torque error, median "
      "% | noise found in the regressor | equations | cut-off, Hz "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Cause& cause : causes) {
    MethodSummary ls, wls, iv;
    std::vector<double> rows, cutoffs;
    for (unsigned r = 0; r < static_cast<unsigned>(plan.repetitions); ++r) {
      const unsigned seed = plan.first_seed + r;
      ClosedLoopOptions loop = robot.loop;
      MotionOptions motion_options;
      cause.change(loop, motion_options);
      const FourierMotion motion = study_motion(robot, plan.motion, seed);
      const ClosedLoopRun run = simulate(robot.truth, motion, loop, seed);
      const StudyData data =
          study_data(robot, cause.true_states ? run.truth : run.measured, &motion, motion_options);
      rows.push_back(data.data.summary.equations.samples());
      cutoffs.push_back(data.source.cutoff.hz);
      const auto scores =
          run_methods(robot, data, heldout, {FitMethod::kLs, FitMethod::kWls, FitMethod::kIv}, {});
      ls.add(scores[0]);
      wls.add(scores[1]);
      iv.add(scores[2]);
    }
    fmt::print(
        "| {} | {} | {} | {} | {} | {} | {:.2f} | {:.4f} | {:.4f} | {}/{} | {:.0f} | {:.2f} |\n",
        cause.name, share(ls.covered), share(ls.textbook_covered), share(wls.covered),
        share(wls.textbook_covered), share(iv.covered), median(wls.errors),
        100 * median(wls.torque_errors), 100 * median(iv.torque_errors), found(iv),
        plan.repetitions, median(rows), median(cutoffs));
    std::fflush(stdout);
  }
}

}  // namespace dyngen::test
