// SPDX-License-Identifier: MIT
// The gradient of a weighted sum of the regressor's elements against differences of the regressor
// in arithmetic of 60 digits: robot files, random chains and trees, before and after the passes.
#include <cln/cln.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "gen/functions/functions.h"
#include "gen/passes/adjoint.h"
#include "tests/support/body_robots.h"
#include "tests/support/compiled_model.h"
#include "tests/support/exact_evaluation.h"
#include "tests/support/model_bridge.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

// Differences with steps of 1e-15 of functions whose third derivatives are below 1e5 or so.
constexpr double kExactTolerance = 1e-22;
// Double arithmetic over some 5000 operations.
constexpr double kDoubleTolerance = 1e-10;

GeneratorOptions gradient_options(ParameterMode mode = ParameterMode::kBaked) {
  GeneratorOptions options;
  options.functions = {"base_regressor", "base_regressor_gradient"};
  options.parameters = mode;
  return options;
}

cln::cl_R digits60(const cln::cl_R& value) { return cln::cl_float(value, cln::float_format(60)); }

/// A motion and weights for the exact evaluation; a joint at rest would meet the jump of sign().
ExactValues exact_inputs(const CodeModel& code, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto value = [&] {
    const int thousandths = static_cast<int>(random() % 5000) - 2500;
    return digits60(cln::cl_R(thousandths >= 0 ? thousandths + 1 : thousandths) / 1000);
  };
  ExactValues inputs;
  const int n = static_cast<int>(code.coordinate_names.size());
  for (const char* array : {"q", "dq", "ddq"}) {
    for (int j = 0; j < n; ++j) inputs[{array, j}] = value();
  }
  for (int k = 0; k < static_cast<int>(code.weights.size()); ++k) inputs[{"A", k}] = value();
  return inputs;
}

cln::cl_R weighted_sum(const Trace& regressor, const ExactValues& inputs) {
  cln::cl_R sum = 0;
  for (const auto& [element, value] : exact_outputs(regressor, 1, inputs)) {
    sum = sum + inputs.at({"A", element.second}) * value;
  }
  return sum;
}

ExactValues differences(const Trace& regressor, const ExactValues& inputs, int n) {
  const cln::cl_R step = digits60(cln::cl_R(1) / cln::expt(cln::cl_I(10), cln::cl_I(15)));
  ExactValues gradient;
  for (const std::string array : {"q", "dq", "ddq"}) {
    for (int j = 0; j < n; ++j) {
      ExactValues before = inputs, after = inputs;
      before[{array, j}] = inputs.at({array, j}) - step;
      after[{array, j}] = inputs.at({array, j}) + step;
      gradient[{"g_" + array, j}] =
          (weighted_sum(regressor, after) - weighted_sum(regressor, before)) / (2 * step);
    }
  }
  return gradient;
}

/// The largest exact difference, before the passes and after them.
double exact_error(const RobotModel& model, ParameterMode mode) {
  const GeneratorOptions options = with_short_search(gradient_options(mode));
  CodeModel code = make_code_model(model, options);
  const int n = static_cast<int>(code.coordinate_names.size());
  const Trace regressor = write_plain_function(parse_function_name("base_regressor"), code).trace;
  const Trace plain =
      write_plain_function(parse_function_name("base_regressor_gradient"), code).trace;
  const Trace short_one =
      write_functions({parse_function_name("base_regressor_gradient")}, code, options.search)
          .front()
          .trace;
  double error = 0;
  for (const unsigned seed : {1U, 2U}) {
    const ExactValues inputs = exact_inputs(code, seed);
    const ExactValues expected = differences(regressor, inputs, n);
    error = std::max(error, exact_difference(exact_outputs(plain, 1, inputs), expected));
    error = std::max(error, exact_difference(exact_outputs(short_one, 1, inputs), expected));
  }
  return error;
}

class RegressorGradient : public testing::TestWithParam<std::string> {};

TEST_P(RegressorGradient, EqualsDifferencesOfTheRegressor) {
  const RobotModel model = with_unknown_parameters(read_model(GetParam()), false);
  EXPECT_LT(exact_error(model, ParameterMode::kBaked), kExactTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, RegressorGradient,
    testing::Values("robots/planar2r.robot", "robots/puma560.robot", "robots/puma560_3dof.robot",
                    "robots/rx90.robot", "robots/tx40.robot", "robots/ur10e.robot",
                    "robots/panda.robot", "robots/stanford.robot", "robots/scara.robot",
                    "robots/sarcos_grla.robot", "robots/kuka_iiwa14.robot",
                    "tests/robots/puma560_corke_std.robot", "tests/robots/odd_angles.robot",
                    "tests/robots/flip3r.robot", "tests/robots/rp.robot",
                    "tests/robots/pendulum.robot"),
    [](const auto& entry) {
      const std::string path = entry.param;
      const std::size_t begin = path.rfind('/') + 1;
      return path.substr(begin, path.rfind('.') - begin);
    });

TEST(RegressorGradientOfRandomRobots, EqualsDifferencesOfTheRegressor) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  robots.insert(robots.end(), trees.begin(), trees.end());
  for (const auto& [name, robot] : robots) {
    RobotModel model = robot_model(robot);
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = name.size() % 2 == 0;
    EXPECT_LT(exact_error(model, ParameterMode::kRuntime), kExactTolerance) << name;
  }
}

TEST(RegressorGradientOfRandomRobots, ComparisonFailsOnAWrongWeight) {
  const GeneratorOptions options = gradient_options();
  CodeModel code = make_code_model(read_model("robots/puma560.robot"), options);
  const Trace regressor = write_plain_function(parse_function_name("base_regressor"), code).trace;
  const Trace gradient =
      write_plain_function(parse_function_name("base_regressor_gradient"), code).trace;
  const ExactValues inputs = exact_inputs(code, 1);
  ExactValues wrong = inputs;
  wrong[{"A", 0}] = inputs.at({"A", 0}) * (1 + cln::cl_R(1) / 1000000);
  EXPECT_GT(exact_difference(exact_outputs(gradient, 1, wrong), differences(regressor, inputs, 6)),
            kExactTolerance);
}

TEST(RegressorGradientOfRandomRobots, TorqueIsAWeightedSumToo) {
  // A = e_i beta': s is the torque of joint i, whose derivatives the generator writes another way
  const RobotModel model = read_model("robots/puma560.robot");
  GeneratorOptions options = gradient_options();
  options.functions = {"friction", "base_regressor_gradient", "id_derivatives"};
  const EvaluatedModel evaluated(model, options);
  const std::size_t n = evaluated.code().coordinate_names.size();
  const std::size_t size = evaluated.code().beta.size();
  RelativeError error;
  for (MotionSample sample : random_samples(static_cast<int>(n), 5, 3)) {
    const std::vector<double> D_q = evaluated.call("id_derivatives", sample, "D_q");
    const std::vector<double> D_dq = evaluated.call("id_derivatives", sample, "D_dq");
    const std::vector<double> D_ddq = evaluated.call("id_derivatives", sample, "D_ddq");
    for (std::size_t i = 0; i < n; ++i) {
      sample.weights.assign(n * size, 0.0);
      std::copy(evaluated.chi().begin(), evaluated.chi().end(),
                sample.weights.begin() + static_cast<std::ptrdiff_t>(i * size));
      const auto row = [&](const std::vector<double>& D) {
        return std::vector<double>(D.begin() + static_cast<std::ptrdiff_t>(i * n),
                                   D.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
      };
      error.add(evaluated.call("base_regressor_gradient", sample, "g_q"), row(D_q));
      error.add(evaluated.call("base_regressor_gradient", sample, "g_dq"), row(D_dq));
      error.add(evaluated.call("base_regressor_gradient", sample, "g_ddq"), row(D_ddq));
    }
  }
  EXPECT_LT(error.value(), kDoubleTolerance);
}

TEST(RegressorGradientInC, ComputesWhatIsEvaluated) {
  const RobotModel model = read_model("robots/scara.robot");
  GeneratorOptions options = gradient_options(ParameterMode::kRuntime);
  options.trig = Trig::kLibm;
  options.gravity = true;
  const CompiledModel compiled(model, options);
  const EvaluatedModel evaluated(model, with_random_values(model, 11), options);
  for (const char* array : {"g_q", "g_dq", "g_ddq"}) {
    RelativeError error;
    error.add(1e-3, 1e-3);
    for (MotionSample sample : random_samples(model.coordinate_count, 20, 5)) {
      std::mt19937_64 random(8);
      for (std::size_t k = 0; k < evaluated.code().weights.size(); ++k) {
        sample.weights.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
      }
      error.add(compiled.call("base_regressor_gradient", sample, evaluated.chi(), array),
                evaluated.call("base_regressor_gradient", sample, array));
    }
    EXPECT_LT(error.value(), 1e-15) << array;
  }
}

TEST(RegressorGradientInC, IsNotAmongTheFunctionsThatNobodyAskedFor) {
  const RobotModel model = read_model("robots/planar2r.robot");
  for (const std::vector<std::string>& functions :
       {std::vector<std::string>{}, std::vector<std::string>{kAllFunctions}}) {
    GeneratorOptions options;
    options.functions = functions;
    EXPECT_EQ(generate(model, options).source.find("gradient"), std::string::npos);
  }
  GeneratorOptions asked;
  asked.functions = {"base_regressor_gradient"};
  const CText text = generate(model, asked);
  EXPECT_NE(text.source.find("const double *A"), std::string::npos);
  EXPECT_EQ(text.source, generate(model, asked).source);
}

TEST(Adjoint, OfAQuotientAndOfSquares) {
  // s = a x^2 / (1 + x sin(x)) + b sign(x), by x
  SymbolTable inputs;
  const auto input = [&](const char* name, int index) {
    return inputs.add({.name = name, .kind = SymbolKind::kInput, .array = name, .index = index});
  };
  const GiNaC::symbol x = input("x", 0), a = input("a", 0), b = input("b", 0);
  Trace function(&inputs);
  const auto angle = function.sin_cos("1", x);
  const GiNaC::ex divisor = function.assign("D", 1 + x * angle.sin);
  function.output("y", 0, x * x / divisor);
  function.output("y", 1, GiNaC::csgn(x));
  const Trace gradient = adjoint(function, {{"y", 0, a}, {"y", 1, b}}, {{x, "g", 0}});
  const ExactValues at = {{{"x", 0}, digits60(cln::cl_R(7) / 10)}, {{"a", 0}, 3}, {{"b", 0}, 2}};
  const double t = 0.7, D = 1 + t * std::sin(t), dD = std::sin(t) + t * std::cos(t);
  EXPECT_NEAR(cln::double_approx(exact_outputs(gradient, 1, at).at({"g", 0})),
              3 * (2 * t / D - t * t * dD / (D * D)), 1e-14);
}

}  // namespace
}  // namespace dyngen::test
