// SPDX-License-Identifier: MIT
#include "gen/program/evaluator.h"

#include <gtest/gtest.h>

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

TEST(ProgramEvaluator, RefusesArraysThatItDoesNotKnow) {
  const Program program = program_of("id");
  EXPECT_THROW(ProgramEvaluator(program, {"q", "dq"}, "tau"), std::invalid_argument);
  EXPECT_THROW(ProgramEvaluator(program, {"q", "dq", "ddq"}, "M"), std::invalid_argument);
  EXPECT_NO_THROW(ProgramEvaluator(program, {"chi", "q", "dq", "ddq"}, "tau"));
}

}  // namespace
}  // namespace dyngen::test
