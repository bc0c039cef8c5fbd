// SPDX-License-Identifier: MIT
// Appendix A of the thesis: the regressor of the 3-DOF Puma, printed and generated.
#include "tests/thesis/appendix_a.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

constexpr int kSamples = 40;

/// A printed coefficient as a number.
double value_of(const std::string& formula, const MotionSample& sample) {
  GiNaC::symtab names;
  GiNaC::exmap values;
  const auto define = [&](const std::string& name, double value) {
    const GiNaC::symbol symbol(name);
    names[name] = symbol;
    values[symbol] = GiNaC::numeric(value);
  };
  for (std::size_t j = 0; j < 3; ++j) {
    const std::string number = std::to_string(j + 1);
    define("q" + number, sample.q[j]);
    define("w" + number, sample.dq[j]);
    define("a" + number, sample.ddq[j]);
    define("S" + number, std::sin(sample.q[j]));
    define("C" + number, std::cos(sample.q[j]));
  }
  define("L", 0.4318);
  define("g", 9.81);
  GiNaC::parser parse(names);
  return to_double(parse(formula).subs(values));
}

class AppendixA : public testing::Test {
 protected:
  static GeneratorOptions options() {
    GeneratorOptions options;
    options.functions = {"base_regressor"};
    return options;
  }

  /// Difference of a coefficient's formula and the generated column, over all samples.
  double error(const std::string& parameter, std::size_t joint, const std::string& formula) const {
    const auto& names = model_.code().beta;
    const auto place = std::find(names.begin(), names.end(), parameter);
    if (place == names.end()) throw std::runtime_error("no base parameter " + parameter);
    const std::size_t column = static_cast<std::size_t>(place - names.begin());
    RelativeError result;
    result.add(1.0, 1.0);  // a coefficient that is zero throughout is judged against 1
    for (const MotionSample& sample : random_samples(3, kSamples, 95)) {
      const std::vector<double> Y = model_.call("base_regressor", sample);
      result.add(value_of(formula, sample), Y[joint * names.size() + column]);
    }
    return result.value();
  }

  EvaluatedModel model_{read_model("robots/puma560_3dof.robot"), options()};
};

TEST_F(AppendixA, BaseParametersAreThoseOfTheAppendix) {
  std::vector<std::string> printed, generated = model_.code().beta;
  for (const PrintedColumn& column : appendix_a()) printed.push_back(column.parameter);
  std::sort(printed.begin(), printed.end());
  std::sort(generated.begin(), generated.end());
  EXPECT_EQ(printed, generated);
}

TEST_F(AppendixA, CoefficientsAreTheGeneratedColumns) {
  for (const PrintedColumn& column : appendix_a()) {
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const bool right = column.correct[joint].empty();
      EXPECT_LT(
          error(column.parameter, joint, right ? column.printed[joint] : column.correct[joint]),
          1e-13)
          << column.parameter << " c" << joint + 1;
    }
  }
}

TEST_F(AppendixA, SlipsOfThePrintAreNoColumns) {
  int slips = 0;
  for (const PrintedColumn& column : appendix_a()) {
    for (std::size_t joint = 0; joint < 3; ++joint) {
      if (column.correct[joint].empty() || column.printed[joint] == "?") continue;
      ++slips;
      EXPECT_GT(error(column.parameter, joint, column.printed[joint]), 1e-3)
          << column.parameter << " c" << joint + 1;
    }
  }
  EXPECT_EQ(slips, 4);
}

}  // namespace
}  // namespace dyngen::test
