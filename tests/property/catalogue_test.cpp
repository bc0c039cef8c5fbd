// SPDX-License-Identifier: MIT
// Every function of the catalogue, every output: the compiled text computes what the evaluated
// program computes, in single precision too.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/compiled_model.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::catalogue_tests {
namespace {

struct CatalogueCase {
  std::string name;
  std::string robot;
  GeneratorOptions options;
};

std::vector<CatalogueCase> cases() {
  GeneratorOptions baked;
  baked.trig = Trig::kLibm;
  GeneratorOptions runtime = baked;
  runtime.parameters = ParameterMode::kRuntime;
  GeneratorOptions arguments = runtime;
  arguments.gravity = arguments.wrench = arguments.payload = true;
  GeneratorOptions standard = arguments;
  standard.regroup = false;
  GeneratorOptions folded = runtime;
  folded.fold = true;
  return {{"scara_folded", "robots/scara.robot", folded},
          {"puma560_baked", "robots/puma560.robot", baked},
          {"panda_runtime", "robots/panda.robot", runtime},
          {"rp_baked", "tests/robots/rp.robot", baked},
          {"stanford_arguments", "robots/stanford.robot", arguments},
          {"odd_angles_standard", "tests/robots/odd_angles.robot", standard},
          {"puma560_3dof_standard", "robots/puma560_3dof.robot", standard}};
}

class Catalogue : public testing::TestWithParam<CatalogueCase> {
 protected:
  /// The largest difference of any output, relative to the largest value of that output.
  void expect_equal(const GeneratorOptions& options, double tolerance) {
    const RobotModel model = read_model(GetParam().robot);
    const CompiledModel compiled(model, options);
    const EvaluatedModel evaluated(model, with_random_values(model, 11), options);
    for (const RobotFunction& function : evaluated.functions()) {
      for (const OutputSpec& output : function.spec->outputs) {
        const std::string name = function.name, array(output.array);
        RelativeError error;
        error.add(1e-3, 1e-3);  // an output that is zero throughout is judged against 0.001
        for (const MotionSample& sample : random_samples(model.coordinate_count, 20, 5)) {
          error.add(compiled.call(name, sample, evaluated.chi(), array),
                    evaluated.call(name, sample, array));
        }
        EXPECT_LT(error.value(), tolerance) << name << " " << array;
      }
    }
  }
};

TEST_P(Catalogue, CompiledEqualsEvaluated) {
  GeneratorOptions options = GetParam().options;
  options.trig = Trig::kInline;  // as the evaluation has them
  // the same operations in the same order
  expect_equal(options, 1e-15);
}

TEST_P(Catalogue, SinglePrecisionAgreesToSinglePrecision) {
  GeneratorOptions options = GetParam().options;
  options.scalar = Scalar::kFloat;
  // forward dynamics solves with a mass matrix of condition 1e4: it is left out; what reads
  // weights, and effects, which these robots do not have, have tests of their own
  const CodeModel code = make_code_model(read_model(GetParam().robot), options);
  for (const FunctionSpec& spec : function_catalogue()) {
    if (spec.name == "fd" || spec.name == "effects" || spec.reads.weights) continue;
    if (spec.why_absent != nullptr && !spec.why_absent(code).empty()) continue;
    options.functions.emplace_back(spec.name);
  }
  expect_equal(options, 1e-4);
}

TEST(Folding, GivesTheSameNumbersWithFewerOperations) {
  for (const char* robot : {"robots/panda.robot", "robots/scara.robot", "tests/robots/rp.robot"}) {
    const RobotModel model = read_model(robot);
    for (const bool arguments : {false, true}) {
      GeneratorOptions options;
      options.parameters = ParameterMode::kRuntime;
      options.gravity = options.wrench = options.payload = arguments;
      GeneratorOptions fold = options;
      fold.fold = true;
      const RobotModel values = with_random_values(model, 3);
      const EvaluatedModel plain(model, values, options), folded(model, values, fold);
      EXPECT_EQ(folded.functions().back().name, "fold");
      for (const RobotFunction& function : plain.functions()) {
        for (const OutputSpec& output : function.spec->outputs) {
          RelativeError error;
          error.add(1e-3, 1e-3);
          for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 9)) {
            const std::string array(output.array);
            error.add(folded.call(function.name, sample, array),
                      plain.call(function.name, sample, array));
          }
          EXPECT_LT(error.value(), 1e-9) << robot << " " << function.name;
        }
      }
      EXPECT_LE(folded.count("id").total(), plain.count("id").total()) << robot;
      EXPECT_GT(folded.count("fold").total(), 0) << robot;
    }
  }
}

TEST(Folding, OfNumbersInTheCodeIsRefused) {
  GeneratorOptions options;
  options.fold = true;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

TEST(Folding, OfFunctionsThatReadNoParameterMakesAnEmptyArray) {
  GeneratorOptions options;
  options.fold = true;
  options.parameters = ParameterMode::kRuntime;
  options.functions = {"fk"};
  const CText text = generate(read_model("robots/planar2r.robot"), options);
  EXPECT_NE(text.header.find("#define PLANAR2R_NFOLDED 0"), std::string::npos);
  EXPECT_NE(text.source.find("void planar2r_fold(const double *chi, double *folded) {\n"
                             "  (void)chi;\n  (void)folded;\n}"),
            std::string::npos)
      << text.source;
}

INSTANTIATE_TEST_SUITE_P(Robots, Catalogue, testing::ValuesIn(cases()),
                         [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace dyngen::test::catalogue_tests
