// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/bench/speed_contest.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_derivatives.h"
#include "tests/support/relative_error.h"

namespace dyngen::bench {
namespace {

// The peers' own rounding is far below it; MuJoCo normalises quaternions.
constexpr double kAgreement = 1e-6;
constexpr double kFloatAgreement = 1e-4;
constexpr std::size_t kChecked = 256;    // states; the judge is slow
constexpr std::size_t kDerivatives = 8;  // and much slower in differences of long double

/// Results of the first states by function, state after state.
struct Results {
  std::string function;
  std::size_t size = 0;  ///< numbers per state
  std::vector<double> values;

  [[nodiscard]] std::vector<double> of_state(std::size_t k) const {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k * size);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
  }
};

test::MotionSample motion(const Sample& sample) {
  const auto list = [&](const double* from) { return std::vector(from, from + sample.joints); };
  return {
      .q = list(sample.q), .dq = list(sample.dq), .ddq = list(sample.ddq), .tau = list(sample.tau)};
}

std::vector<double> times(const std::vector<double>& Y, const std::vector<double>& beta) {
  std::vector<double> tau(Y.size() / beta.size());
  for (std::size_t i = 0; i < Y.size(); ++i) tau[i / beta.size()] += Y[i] * beta[i % beta.size()];
  return tau;
}

/// Central differences of the judge's torques. Coulomb friction has no derivative where a
/// difference crosses rest and a derivative of 0 elsewhere.
std::vector<double> judged_derivatives(const RobotModel& model, test::NumericRobot robot,
                                       const test::MotionSample& sample) {
  for (test::NumericJoint& joint : robot.joints) joint.Fs = 0;
  const test::TorqueDerivatives D = test::torque_derivatives(model, robot, sample);
  std::vector<double> result;
  for (const auto* matrix : {&D.position, &D.velocity, &D.acceleration}) {
    result.insert(result.end(), matrix->begin(), matrix->end());
  }
  return result;
}

/// Largest difference from the judge, who sees the robot as `numbers`.
class Comparison {
 public:
  Comparison(const Contest& contest, const test::NumericRobot& numbers)
      : contest_(contest), numbers_(numbers) {}

  [[nodiscard]] double error(const Results& results) const {
    const bool differences = results.function == "id_derivatives";
    test::RelativeError error;
    for (std::size_t k = 0; k < (differences ? kDerivatives : kChecked); ++k) {
      add(error, results.function, results.of_state(k), motion(contest_.states.sample(k)));
    }
    return error.value();
  }

 private:
  void add(test::RelativeError& error, const std::string& function,
           const std::vector<double>& values, test::MotionSample sample) const {
    const RobotModel& model = contest_.robot.model;
    if (function == "id_derivatives") {
      error.add(values, judged_derivatives(model, numbers_, sample));
    } else if (function == "base_regressor") {
      error.add(times(values, contest_.robot.plain.chi),
                test::judge(model, numbers_, "id", sample));
    } else if (function == "fd") {  // the accelerations must give back the torques
      sample.ddq = values;
      error.add(test::judge(model, numbers_, "id", sample), sample.tau);
    } else {
      const std::string judged = function == "id libm" ? "id" : function;
      error.add(values, test::judge(model, numbers_, judged, sample));
    }
  }

  const Contest& contest_;
  const test::NumericRobot& numbers_;
};

bool report(const Contest& contest, const std::string& what, double error,
            double limit = kAgreement) {
  const bool good = error < limit;
  fmt::print("{:<14} {:<30} differs by {:.1e}{}\n", contest.robot.name, what, error,
             good ? "" : ": too much");
  return good;
}

std::size_t result_size(const Contest& contest, const std::string& function) {
  const std::size_t joints = contest.states.joints;
  if (function == "mass_matrix") return joints * joints;
  if (function == "id_derivatives") return 3 * joints * joints;
  if (function == "base_regressor") return joints * contest.robot.plain.chi.size();
  return joints;
}

Results empty_results(const Contest& contest, const std::string& function) {
  const std::size_t size = result_size(contest, function);
  return {function, size, std::vector<double>(size * kChecked)};
}

bool verify_batches(const Contest& contest, const Emitted& emitted, const std::string& who) {
  const std::size_t joints = contest.states.joints;
  std::vector<double> single(kBatch * joints), batch(kBatch * joints);
  std::vector<float> batch_float(kBatch * joints);
  emitted.sweeps.at("id")(contest.states, kBatch, single.data(), joints);
  emitted.id_batch(contest.batch, batch.data());
  emitted.id_batch_float(contest.batch_float, batch_float.data());
  const std::vector<double> expected = joint_major<double>(single, joints, kBatch);
  const bool good = report(contest, "id_batch, " + who, test::relative_error(batch, expected));
  return report(contest, "id_batch float, " + who, test::relative_error(batch_float, expected),
                kFloatAgreement) &&
         good;
}

bool verify_emitted(const Contest& contest, const Emitted& emitted, const std::string& who) {
  const Comparison comparison(contest, contest.robot.numbers);
  bool good = true;
  for (const auto& [function, sweep] : emitted.sweeps) {
    Results results = empty_results(contest, function);
    sweep(contest.states, kChecked, results.values.data(), results.size);
    good &= report(contest, function + ", " + who, comparison.error(results));
  }
  return verify_batches(contest, emitted, who) && good;
}

bool verify_evaluated(const Contest& contest) {
  const std::size_t joints = contest.states.joints;
  std::vector<double> single(kStates * joints);
  contest.robot.plain.sweeps.at("id")(contest.states, kStates, single.data(), joints);
  EvaluatedId evaluated(contest);
  return report(contest, "id, evaluate",
                test::relative_error(evaluated(), joint_major<double>(single, joints, kStates)));
}

}  // namespace

bool verify(const Contest& contest) {
  bool good = verify_emitted(contest, contest.robot.plain, "-O2");
  good &= verify_emitted(contest, contest.robot.native, "native");
  good &= verify_evaluated(contest);
  const Comparison comparison(contest, contest.rigid);
  for (const auto& [who, peer] : contest.peers) {
    for (const auto& [function, call] : peer) {
      Results results = empty_results(contest, function);
      for (std::size_t k = 0; k < kChecked; ++k) call(k, &results.values[k * results.size]);
      good &= report(contest, fmt::format("{}, {}", function, who), comparison.error(results));
    }
  }
  return good;
}

}  // namespace dyngen::bench
