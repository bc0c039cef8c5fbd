// SPDX-License-Identifier: MIT
// Every function of the catalogue on robots of few joints, on which statements are used in part: a
// sine without its cosine, a length without its partner. Each function has a judge of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/support/compiled_model.h"
#include "tests/support/frame_error.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_centroid.h"
#include "tests/support/numeric_derivatives.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

using Vector = std::vector<double>;

// Double arithmetic over some hundred operations.
constexpr double kTolerance = 1e-11;
// Central differences of eighth order with steps of 0.01: rounding 1e-16 / 0.01 of the largest
// value, truncation below it.
constexpr double kDifferenceTolerance = 1e-10;
constexpr double kStep = 0.01;

/// The derivative at 0.
double slope(const std::function<double(double)>& function) {
  constexpr double kWeights[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  double sum = 0;
  for (int k = 1; k <= 4; ++k) {
    sum += kWeights[k - 1] * (function(k * kStep) - function(-k * kStep));
  }
  return sum / kStep;
}

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b.at(k);
  return sum;
}

/// Row-major matrix times vector.
Vector times(const Vector& matrix, const Vector& x) {
  Vector result(x.empty() ? 0 : matrix.size() / x.size(), 0.0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t k = 0; k < x.size(); ++k) result[i] += matrix[i * x.size() + k] * x[k];
  }
  return result;
}

/// Motions in which no joint is so slow that a difference crosses the jump of sign(dq).
std::vector<MotionSample> moving_samples(const RobotModel& model, std::size_t weights) {
  std::vector<MotionSample> samples = random_samples(model.coordinate_count, 4, 23);
  samples.erase(samples.begin());  // at rest
  std::mt19937_64 random(5);
  for (MotionSample& sample : samples) {
    for (double& rate : sample.dq) rate += std::copysign(10 * kStep, rate);
    for (std::size_t k = 0; k < weights; ++k) {
      sample.weights.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
    }
  }
  return samples;
}

/// One robot in one mode: all functions, each against its judge.
class Judged {
 public:
  Judged(const RobotModel& model, const RobotModel& values, GeneratorOptions options)
      : model_(model),
        values_(values),
        options_(with_all(std::move(options))),
        numbers_(numeric_robot(values)),
        code_(model, values, options_),
        samples_(moving_samples(model, code_.code().weights.size())) {
    GeneratorOptions regrouped;
    regrouped.functions = {"friction"};
    beta_ = EvaluatedModel(model, values, regrouped).chi();
  }

  void check() {
    check_torques();
    check_forward_dynamics();
    check_regressors();
    check_energy();
    check_derivatives();
    check_gradient();
    check_frames();
    check_coriolis_matrices();
    check_wrenches();
    check_centroid();
    std::set<std::string> unchecked;
    for (const RobotFunction& function : code_.functions()) unchecked.insert(function.name);
    for (const std::string& name : checked_) unchecked.erase(name);
    unchecked.erase("fold");  // every other function of folded code reads it
    EXPECT_TRUE(unchecked.empty()) << *unchecked.begin();
  }

 private:
  static GeneratorOptions with_all(GeneratorOptions options) {
    options.functions = {kAllFunctions, "base_regressor_gradient"};
    return options;
  }

  [[nodiscard]] bool has(const std::string& name) const {
    const auto& all = code_.functions();
    return std::any_of(all.begin(), all.end(),
                       [&](const RobotFunction& function) { return function.name == name; });
  }
  Vector call(const std::string& name, const MotionSample& sample, const std::string& output = {}) {
    checked_.insert(name);
    return code_.call(name, sample, output);
  }

  void check_torques() {
    for (const std::string name :
         {"id", "id_rigid", "gravity", "coriolis", "friction", "mass_matrix"}) {
      RelativeError error = against_one();
      for (const MotionSample& sample : samples_) {
        error.add(call(name, sample), judge(values_, numbers_, name, sample));
      }
      EXPECT_LT(error.value(), kTolerance) << name;
    }
  }

  void check_forward_dynamics() {
    if (!has("fd")) return;
    for (MotionSample sample : samples_) {
      sample.ddq = call("fd", sample);
      RelativeError error = against_one();
      error.add(judge(values_, numbers_, "id", sample), sample.tau);
      EXPECT_LT(error.value(), 1e-7) << "fd";  // mass matrices of a condition of 1e4 or so
    }
  }

  void check_regressors() {
    RelativeError standard = against_one(), base = against_one(), gravity = against_one();
    for (const MotionSample& sample : samples_) {
      const Vector tau = judge(values_, numbers_, "id", sample);
      if (!code_.chi().empty()) {
        standard.add(times(call("regressor", sample), code_.chi()), tau);
      }
      if (!beta_.empty()) {
        base.add(times(call("base_regressor", sample), beta_), tau);
        gravity.add(times(call("gravity_regressor", sample), beta_),
                    judge(values_, numbers_, "gravity", sample));
      }
    }
    checked_.insert({"regressor", "base_regressor", "gravity_regressor"});
    EXPECT_LT(standard.value(), kTolerance) << "regressor";
    EXPECT_LT(base.value(), kTolerance) << "base_regressor";
    EXPECT_LT(gravity.value(), kTolerance) << "gravity_regressor";
  }

  /// dq' Y = dH/dt + P, column by column.
  void check_energy() {
    RelativeError error = against_one();
    for (const MotionSample& sample : samples_) {
      const Vector Y = call("base_regressor", sample), P = call("power", sample);
      for (std::size_t c = 0; c < P.size(); ++c) {
        double work = 0;
        for (std::size_t i = 0; i < sample.dq.size(); ++i) {
          work += sample.dq[i] * Y[i * P.size() + c];
        }
        const double rate = slope([&](double t) {
          MotionSample at = sample;
          for (std::size_t i = 0; i < at.q.size(); ++i) {
            at.q[i] += (sample.dq[i] + sample.ddq[i] * t / 2) * t;
            at.dq[i] += sample.ddq[i] * t;
          }
          return call("energy_regressor", at)[c];
        });
        error.add(rate + P[c], work);
      }
    }
    checked_.insert({"energy_regressor", "power"});
    // energies of fast motions change 20 times in a step's scale: truncation is larger here
    EXPECT_LT(error.value(), 1e-7) << "energy_regressor, power";
  }

  void check_derivatives() {
    std::vector<RelativeError> errors(6, against_one());
    for (MotionSample sample : samples_) {
      sample.wrench.clear();
      const TorqueDerivatives expected = torque_derivatives(values_, numbers_, sample);
      errors[0].add(call("id_dq_pos", sample), expected.position);
      errors[1].add(call("id_dq", sample), expected.velocity);
      errors[2].add(call("id_ddq", sample), expected.acceleration);
      errors[3].add(call("id_derivatives", sample, "D_q"), expected.position);
      errors[4].add(call("id_derivatives", sample, "D_dq"), expected.velocity);
      errors[5].add(call("id_derivatives", sample, "D_ddq"), expected.acceleration);
    }
    for (const RelativeError& error : errors) EXPECT_LT(error.value(), kDifferenceTolerance);
  }

  void check_gradient() {
    if (!has("base_regressor_gradient")) return;
    for (const auto& [output, input] :
         {std::pair{"g_q", &MotionSample::q}, std::pair{"g_dq", &MotionSample::dq},
          std::pair{"g_ddq", &MotionSample::ddq}}) {
      RelativeError error = against_one();
      for (const MotionSample& sample : samples_) {
        const Vector gradient = call("base_regressor_gradient", sample, output);
        for (std::size_t i = 0; i < gradient.size(); ++i) {
          error.add(gradient[i], slope([&, varied = input](double step) {
                      MotionSample at = sample;
                      (at.*varied)[i] += step;
                      return dot(call("base_regressor", at), sample.weights);
                    }));
        }
      }
      EXPECT_LT(error.value(), kDifferenceTolerance) << output;
    }
  }

  void check_frames() {
    EXPECT_LT(frame_error(model_, values_, options_, 3), 1e-12);
    checked_.insert({"fk", "jacobian"});
  }

  void check_coriolis_matrices() {
    RelativeError christoffel = against_one(), torque = against_one();
    for (const MotionSample& sample : samples_) {
      const Vector c = judge(values_, numbers_, "coriolis", sample);
      christoffel.add(call("coriolis_matrix", sample),
                      christoffel_matrix(values_, numbers_, sample));
      torque.add(times(call("coriolis_matrix_fast", sample), sample.dq), c);
    }
    EXPECT_LT(christoffel.value(), kTolerance) << "coriolis_matrix";
    EXPECT_LT(torque.value(), kTolerance) << "coriolis_matrix_fast";
  }

  void check_wrenches() {
    RelativeError error = against_one();
    for (const MotionSample& sample : samples_) {
      const std::vector<long double> w(sample.wrench.begin(), sample.wrench.end());
      const auto last = static_cast<std::size_t>(model_.size() - 1);
      error.add(call("external_torque", sample),
                torque_of_wrench(values_, numbers_, sample.q, last, w));
    }
    EXPECT_LT(error.value(), kTolerance) << "external_torque";
  }

  /// Of robots whose bodies the code knows.
  void check_centroid() {
    if (!has("com")) return;
    std::vector<RelativeError> errors(3, against_one());
    for (const MotionSample& sample : samples_) {
      const NumericCentroid expected = numeric_centroid(values_, numbers_, sample);
      const auto list = [](const auto& array) {
        return std::vector<long double>(array.begin(), array.end());
      };
      errors[0].add(call("com", sample), list(expected.center));
      errors[1].add(call("com_jacobian", sample), expected.jacobian);
      errors[2].add(call("momentum", sample), list(expected.momentum));
    }
    for (const RelativeError& error : errors) EXPECT_LT(error.value(), kTolerance) << "com";
  }

  static RelativeError against_one() {
    RelativeError error;
    error.add(1.0, 1.0);
    return error;
  }

  const RobotModel& model_;
  const RobotModel& values_;
  GeneratorOptions options_;
  NumericRobot numbers_;
  EvaluatedModel code_;
  std::vector<MotionSample> samples_;
  Vector beta_;
  std::set<std::string> checked_;
};

void check_robot(const RobotModel& model) {
  const RobotModel values = with_random_values(model, 3);
  std::vector<GeneratorOptions> modes = every_mode();
  GeneratorOptions folded;
  folded.parameters = ParameterMode::kRuntime;
  folded.fold = true;
  modes.push_back(folded);
  for (const GeneratorOptions& options : modes) Judged(model, values, options).check();
}

struct SmallRobot {
  std::string name;
  std::string rows;  ///< geometry and gravity
  int joints = 1;
};

const std::vector<SmallRobot>& small_robots() {
  static const std::vector<SmallRobot> robots = {
      {"pendulum", "al pi/2\ngz 9.81\n", 1},
      {"pendulum_at_an_angle", "al pi/3\nth 0.3\ngz 9.81\n", 1},
      {"turntable", "gz 9.81\n", 1},
      {"slide", "sigma 1\nal pi/2\ngz 9.81\n", 1},
      {"pan_tilt", "al 0 pi/2\ngz 9.81\n", 2},
      {"pan_tilt_offset", "al 0 pi/2\nd 0 0.1\nr 0.3 0\ngz 9.81\n", 2},
      {"tilt_roll", "al pi/2 pi/2\nr 0 0.2\ngz 9.81\n", 2},
      {"two_bars", "d 0 0.5\ngy 9.81\n", 2},
      {"polar", "sigma 0 1\nal pi/2 pi/2\ngz 9.81\n", 2},
      {"standard_pan_tilt", "dh standard\nal pi/2 0\nd 0 0.4\ngz 9.81\n", 2},
      {"gantry_and_wrist", "sigma 1 1 1 0\nal 0 pi/2 pi/2 0\nth 0 pi/2 pi/2 0\ngz 9.81\n", 4},
      {"two_pendulums_on_a_base", "ant 0 0\nal pi/2 pi/2\nd 0 1\ngz 9.81\n", 2},
      {"pan_fixed_tilt", "sigma 0 2 0\nal 0 pi/2 0\nd 0 0.1 0.2\ngz 9.81\n", 3},
  };
  return robots;
}

constexpr const char* kInertialRows[] = {"XX", "XY", "XZ", "YY", "YZ", "ZZ", "mX", "mY", "mZ", "m"};

/// Which parameters are known to be zero is drawn; the others are unknown.
std::string sparse_text(const SmallRobot& robot, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::string text = "name small\nnumber_link " + std::to_string(robot.joints) + "\n" + robot.rows;
  for (const char* row : kInertialRows) {
    text += row;
    for (int j = 0; j < robot.joints; ++j) text += random() % 3 == 0 ? " *" : " 0";
    text += "\n";
  }
  return text + "stop\n";
}

class SmallRobots : public testing::TestWithParam<SmallRobot> {};

TEST_P(SmallRobots, EveryFunctionEqualsItsJudgeWithEverythingUnknown) {
  std::string text = "name small\nnumber_link " + std::to_string(GetParam().joints) + "\n";
  text += GetParam().rows + "stop\n";
  check_robot(with_unknown_parameters(parse_model(text), false));
}

TEST_P(SmallRobots, EveryFunctionEqualsItsJudgeWithFewParameters) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string text = sparse_text(GetParam(), seed);
    SCOPED_TRACE(text);
    check_robot(parse_model(text));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, SmallRobots, testing::ValuesIn(small_robots()),
                         [](const auto& entry) { return entry.param.name; });

TEST(SmallRobot, ThePendulumOfOneFirstMoment) {
  const RobotModel model = read_model("tests/data/cases/pendulum_gradient/pend.robot");
  check_robot(model);
  // by hand: tau = ZZ ddq + MX g cos(q)
  GeneratorOptions options;
  options.functions = {"base_regressor_gradient"};
  const EvaluatedModel evaluated(model, with_random_values(model, 3), options);
  MotionSample sample{.q = {0.7}, .dq = {0.3}, .ddq = {2}};
  sample.weights = {0.5, -2};  // of ZZ1 and MX1
  ASSERT_EQ(evaluated.code().beta.size(), 2U);
  EXPECT_NEAR(evaluated.call("base_regressor_gradient", sample, "g_q")[0], 2 * 9.81 * std::sin(0.7),
              1e-14);
  EXPECT_EQ(evaluated.call("base_regressor_gradient", sample, "g_dq")[0], 0.0);
  EXPECT_EQ(evaluated.call("base_regressor_gradient", sample, "g_ddq")[0], 0.5);
  const CompiledModel compiled(model, options);
  EXPECT_NEAR(compiled.call("base_regressor_gradient", sample, evaluated.chi(), "g_q")[0],
              2 * 9.81 * std::sin(0.7), 1e-14);
}

}  // namespace
}  // namespace dyngen::test
