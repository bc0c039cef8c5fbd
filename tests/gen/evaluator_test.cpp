// SPDX-License-Identifier: MIT
#include "gen/program/evaluator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "gen/generator/generator.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

Program program_of(const std::string& function) {
  GeneratorOptions options;
  options.functions = {function};
  CodeModel code = make_code_model(read_model("robots/puma560.robot"), with_short_search(options));
  return lower(write_functions(code, with_short_search(options)).front().trace);
}

TEST(ProgramEvaluator, RoundsAsTheEvaluationOfManySamples) {
  const Program program = program_of("id");
  ProgramEvaluator evaluator(program, {"q", "dq", "ddq"}, "tau");
  ProgramEvaluator copy = evaluator;
  for (const MotionSample& sample : random_samples(6, 20, 1)) {
    std::vector<double> batch(6), single(6), copied(6);
    evaluate(program, 1, {{"q", sample.q}, {"dq", sample.dq}, {"ddq", sample.ddq}},
             {{"tau", batch}});
    evaluator.run({sample.q.data(), sample.dq.data(), sample.ddq.data()}, single.data());
    copy.run({sample.q.data(), sample.dq.data(), sample.ddq.data()}, copied.data());
    EXPECT_EQ(single, batch);
    EXPECT_EQ(copied, batch);
  }
}

TEST(Program, ForSomeResultsHasTheirStepsAlone) {
  const Program program = program_of("mass_matrix");
  const auto wanted = [](const Program::Result& result) { return result.index % 6 == 4; };
  const Program part = with_results(program, wanted);
  EXPECT_EQ(part.results.size(), 6U);
  EXPECT_LT(part.instructions.size(), program.instructions.size());
  for (const MotionSample& sample : random_samples(6, 5, 1)) {
    std::vector<double> all(36), some(36, -1e9);
    evaluate(program, 1, {{"q", sample.q}}, {{"M", all}});
    evaluate(part, 1, {{"q", sample.q}}, {{"M", some}});
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(some[i], i % 6 == 4 ? all[i] : -1e9);
  }
  const Program nothing = with_results(program, [](const Program::Result&) { return false; });
  EXPECT_TRUE(nothing.instructions.empty());
  EXPECT_TRUE(nothing.inputs.empty());
}

// sin(q1 + dq1) of far angles too: a block has both roads
TEST(Program, HasTheSinesOfTheCLibrary) {
  Program program;
  program.inputs = {{"x", 0, 0, false}};
  program.instructions = {{Instruction::Op::kSin, 1, 0, 0}, {Instruction::Op::kCos, 2, 0, 0}};
  program.results = {{"s", 0, 1}, {"c", 0, 2}};
  program.register_count = 3;
  std::mt19937_64 random(1);
  for (const double reach : {1e-3, 3.2, 1e3, 1e5, 1e9}) {
    std::vector<double> x(300), s(300), c(300);
    for (double& angle : x) angle = std::uniform_real_distribution(-reach, reach)(random);
    x[17] = 0;
    x[18] = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {x.size(), std::size_t{18}}) {
      evaluate(program, count, {{"x", x}}, {{"s", s}, {"c", c}});
      for (std::size_t i = 0; i < count; ++i) {
        if (i == 18) continue;
        const double ulp = std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(s[i], std::sin(x[i]), ulp * std::abs(s[i])) << x[i];
        EXPECT_NEAR(c[i], std::cos(x[i]), ulp * std::abs(c[i])) << x[i];
      }
      EXPECT_EQ(s[17], 0);
      EXPECT_EQ(c[17], 1);
      if (count > 18) EXPECT_TRUE(std::isnan(s[18]));
    }
  }
}

TEST(Program, InTwoPartsRoundsAsTheWhole) {
  const Program program = program_of("id");
  const SplitProgram split = split_ahead_of(program, "ddq");
  EXPECT_LT(split.rest.instructions.size(), program.instructions.size());
  EXPECT_EQ(split.rest.instructions.size() + split.ahead.instructions.size(),
            program.instructions.size());
  for (const MotionSample& sample : random_samples(6, 5, 1)) {
    std::vector<double> whole(6), rest(6), ahead(static_cast<std::size_t>(split.carried));
    evaluate(program, 1, {{"q", sample.q}, {"dq", sample.dq}, {"ddq", sample.ddq}},
             {{"tau", whole}});
    evaluate(split.ahead, 1, {{"q", sample.q}, {"dq", sample.dq}}, {{"ahead", ahead}});
    evaluate(split.rest, 1, {{"ddq", sample.ddq}, {"ahead", ahead}}, {{"tau", rest}});
    EXPECT_EQ(rest, whole);
  }
  const SplitProgram nothing_ahead = split_ahead_of(program_of("gravity"), "q");
  EXPECT_EQ(nothing_ahead.carried, 0);
}

TEST(ProgramEvaluator, RefusesArraysThatItDoesNotKnow) {
  const Program program = program_of("id");
  EXPECT_THROW(ProgramEvaluator(program, {"q", "dq"}, "tau"), std::invalid_argument);
  EXPECT_THROW(ProgramEvaluator(program, {"q", "dq", "ddq"}, "M"), std::invalid_argument);
  EXPECT_NO_THROW(ProgramEvaluator(program, {"chi", "q", "dq", "ddq"}, "tau"));
}

}  // namespace
}  // namespace dyngen::test
