// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gen/passes/conversion.h"
#include "gen/passes/fold.h"
#include "gen/passes/optimise.h"
#include "gen/symbols/calls.h"
#include "gen/trace/assign_calls.h"
#include "tests/support/exact_evaluation.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

const SearchOptions kShort = {.patience = 2, .work = 10000};

constexpr double kExact = 1e-40;  // of 60 digits; sums of some thousand terms lose few

/// A function of inputs q.
class PassesTest : public testing::Test {
 protected:
  PassesTest() {
    for (int i = 0; i < 6; ++i) {
      SymbolInfo info;
      info.name = std::string(1, "abcdef"[i]);
      info.kind = SymbolKind::kInput;
      info.array = "q";
      info.index = i;
      input_.push_back(inputs_.add(std::move(info)));
    }
  }

  void expect_operations(int wanted) const {
    const Trace after = optimised(trace_);
    EXPECT_EQ(after.count().total(), wanted);
    EXPECT_LT(exact_difference(exact_outputs(trace_, 1), exact_outputs(after, 1)), kExact);
  }

  SymbolTable inputs_;
  std::vector<GiNaC::ex> input_;
  Trace trace_{&inputs_};
};

TEST_F(PassesTest, CommonFactorIsTakenOut) {
  trace_.output("y", 0, input_[0] * input_[1] + input_[0] * input_[2] - input_[0] * input_[3]);
  expect_operations(3);  // a * (b + c - d)
}

TEST_F(PassesTest, SumThatExistsIsReadUpToSign) {
  trace_.output("y", 0, trace_.assign("s", input_[1] - input_[2]));
  trace_.output("y", 1, input_[0] * input_[2] - input_[0] * input_[1] + input_[3]);
  expect_operations(3);  // s = b - c; d - a * s
}

TEST_F(PassesTest, StandInOfOtherSignLeavesItsOtherReadsAlone) {
  const GiNaC::ex t = trace_.assign("t", input_[2] * input_[3] - input_[1]);
  trace_.output("y", 0, t);
  trace_.output("y", 1, input_[4] + input_[1] - input_[2] * input_[3] - t * input_[0]);
  expect_operations(5);  // t = c * d - b; e - t - t * a
}

TEST_F(PassesTest, OtherReadsOfASumThatIsFoundNegatedKeepTheirSign) {
  const GiNaC::ex s = trace_.assign("s", input_[4] - input_[2] * input_[3]);
  trace_.output("y", 0, s);
  trace_.output("y", 1, input_[0] * s + input_[2] * input_[3] - input_[4] + input_[5]);
  expect_operations(5);  // s = e - c * d; a * s - s + f
}

TEST_F(PassesTest, LongProductsAreSharedAcrossStatements) {
  trace_.output("y", 0, input_[0] * input_[1] * input_[2] + input_[3]);
  trace_.output("y", 1, input_[2] * input_[1] * input_[0] - input_[4]);
  expect_operations(4);
}

TEST_F(PassesTest, SingleUseIntermediateIsOpenedForAFactor) {
  const GiNaC::ex inner = trace_.assign("s", input_[0] * input_[1] + input_[2]);
  trace_.output("y", 0, inner + input_[0] * input_[3]);
  expect_operations(3);  // a * (b + d) + c
}

TEST_F(PassesTest, LikeTermsAreAdded) {
  const GiNaC::ex twice = trace_.assign("s", input_[0] + input_[1]);
  trace_.output("y", 0, twice - input_[1] + input_[2]);
  expect_operations(1);
}

TEST_F(PassesTest, ConstantsOfOneProductAreMultiplied) {
  const GiNaC::ex g = trace_.constant("g", GiNaC::numeric(981, 100));
  const GiNaC::ex l = trace_.constant("l", GiNaC::numeric(1, 2));
  trace_.output("y", 0, g * trace_.assign("s", l * input_[0]));
  expect_operations(1);
}

TEST_F(PassesTest, WhatCannotBeImprovedStaysAsItIs) {
  const GiNaC::ex part = trace_.assign("part", input_[0] * input_[1]);
  trace_.output("y", 0, trace_.assign("whole", part + input_[2]));
  const Trace after = optimised(trace_);
  ASSERT_EQ(after.assignments().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(after.assignments()[i].target.is_equal(trace_.assignments()[i].target));
    EXPECT_TRUE(after.assignments()[i].value.is_equal(trace_.assignments()[i].value));
  }
}

TEST_F(PassesTest, ReciprocalsAreDividedOnce) {
  const GiNaC::ex divisor = trace_.assign("D", input_[0] * input_[1] + input_[2]);
  const GiNaC::ex inverse = trace_.assign("I", 1 / divisor);
  trace_.output("y", 0, inverse * input_[3] + inverse * input_[4]);
  trace_.output("y", 1, inverse * input_[5]);
  const Trace after = optimised(trace_);
  EXPECT_EQ(after.count().divisions, 1);
  expect_operations(5);
}

TEST_F(PassesTest, DifferenceOfUnequalFunctionsIsSeen) {
  Trace other(&inputs_);
  trace_.output("y", 0, input_[0] * input_[1]);
  other.output("y", 0, input_[0] * input_[2]);
  EXPECT_GT(exact_difference(exact_outputs(trace_, 1), exact_outputs(other, 1)), 1e-9);
}

/// A call of something; never of what is not real.
GiNaC::ex random_call(std::size_t which, const GiNaC::ex& a, const GiNaC::ex& b) {
  switch (which) {
    case 0:
      return GiNaC::exp(-a * a);
    case 1:
      return GiNaC::tanh(a - 2 * b);
    case 2:
      return real_abs(a * b);
    case 3:
      return real_min(a, real_max(b, -GiNaC::numeric(1, 2)));
    case 4:
      return real_sqrt(1 + a * a);
    case 5:
      return real_pow(1 + b * b, GiNaC::numeric(7, 10));
    case 6:
      return GiNaC::log(2 + GiNaC::csgn(a - b));
    case 7:
      return decay_mean(real_abs(a));
    default:
      return GiNaC::sin(3 * a + b);
  }
}

/// Sums of products of what stands before, with squares, constants, calls, quotients and brackets.
/// @param calls  others than sine, cosine and sign too
Trace random_trace(const SymbolTable* inputs, const std::vector<GiNaC::ex>& input,
                   std::uint64_t seed, bool calls = false) {
  std::mt19937_64 random(seed);
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  Trace trace(inputs);
  std::vector<GiNaC::ex> known = input;
  known.push_back(trace.constant("k", GiNaC::numeric(3, 7)));
  known.push_back(trace.constant("l", GiNaC::numeric(-5, 2)));
  const Trace::SinCos angle = trace.sin_cos("1", input[0] + input[1]);
  known.push_back(angle.sin);
  known.push_back(angle.cos);
  const int statements = 3 + static_cast<int>(pick(25));
  for (int i = 0; i < statements; ++i) {
    GiNaC::ex sum = 0;
    const std::size_t terms = 1 + pick(5);
    for (std::size_t t = 0; t < terms; ++t) {
      GiNaC::ex term = pick(2) == 0 ? 1 : -1;
      const std::size_t factors = 1 + pick(3);
      for (std::size_t f = 0; f < factors; ++f) term *= known[pick(known.size())];
      if (pick(8) == 0) term *= known[pick(known.size())] - known[pick(known.size())];
      if (pick(12) == 0) term *= 2;
      if (pick(12) == 0) term *= GiNaC::csgn(input[pick(input.size())]);
      if (pick(15) == 0) term /= input[pick(input.size())];
      if (calls && pick(6) == 0) {
        // powers that grow from statement to statement would leave no digit for a sine
        const GiNaC::ex argument = GiNaC::tanh(known[pick(known.size())]);
        const GiNaC::ex call = random_call(pick(9), argument, known[pick(input.size())]);
        term = assign_calls(trace, "c" + std::to_string(i), term * call);
      }
      sum += term;
    }
    const GiNaC::ex value = trace.assign("v" + std::to_string(i), sum);
    if (GiNaC::is_a<GiNaC::symbol>(value)) known.push_back(value);
    if (pick(3) == 0 || i + 1 == statements) {
      trace.output("y", static_cast<int>(trace.outputs().size()), value);
    }
  }
  trace.drop_dead_code();
  return trace;
}

bool reads_array(const Trace& trace, const std::string& array) {
  const auto reads = [&](const GiNaC::ex& value) {
    for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
      if (GiNaC::is_a<GiNaC::symbol>(*it) && trace.symbols().info(*it).array == array) return true;
    }
    return false;
  };
  return std::any_of(trace.assignments().begin(), trace.assignments().end(),
                     [&](const Assignment& assignment) { return reads(assignment.value); }) ||
         std::any_of(trace.outputs().begin(), trace.outputs().end(),
                     [&](const Output& output) { return reads(output.value); });
}

/// Each name once, assigned before it is read.
void expect_well_formed(const Trace& trace) {
  std::set<std::string> names;
  for (const Assignment& assignment : trace.assignments()) {
    const std::string name = assignment.target.get_name();
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_"),
              std::string::npos)
        << name;
    EXPECT_EQ(std::string("0123456789").find(name[0]), std::string::npos) << name;
  }
}

/// fold and the folded functions are the functions, with no more operations each.
void expect_folded(const std::vector<Trace>& before, SymbolTable& inputs) {
  const FoldedFunctions folded = fold_parameters(before, inputs, kShort);
  const ExactValues entries = exact_outputs(folded.fold, 7);
  ASSERT_EQ(entries.size(), folded.names.size());
  expect_well_formed(folded.fold);
  ASSERT_EQ(folded.functions.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Trace& after = folded.functions[i];
    const OperationCount count = after.count(), old = before[i].count();
    EXPECT_LE(count.total() + count.divisions, old.total() + old.divisions) << i;
    EXPECT_FALSE(reads_array(after, "chi")) << i;
    const ExactValues wanted = exact_outputs(before[i], 7);
    EXPECT_LT(exact_difference(wanted, exact_outputs(after, 7, entries)), kExact) << i;
    const Trace shorter = optimised(after, {.patience = 0});
    EXPECT_LT(exact_difference(wanted, exact_outputs(shorter, 7, entries)), kExact) << i;
  }
}

/// The pass keeps values, is what it counts, and costs no more.
void expect_kept(const Trace& before, const std::string& name) {
  const Trace after = optimised(before, kShort);
  expect_well_formed(after);
  EXPECT_LE(after.count().total(), before.count().total()) << name;
  EXPECT_LE(after.count().divisions, before.count().divisions) << name;
  EXPECT_EQ(after.count().sin_cos_pairs, before.count().sin_cos_pairs) << name;
  EXPECT_LT(exact_difference(exact_outputs(before, 7), exact_outputs(after, 7)), kExact) << name;
}

TEST_F(PassesTest, RandomProgramsKeepTheirValues) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    expect_kept(random_trace(&inputs_, input_, seed), "seed " + std::to_string(seed));
  }
}

TEST_F(PassesTest, RandomProgramsWithCallsKeepTheirValues) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Trace before = random_trace(&inputs_, input_, seed, true);
    expect_kept(before, "seed " + std::to_string(seed));
    EXPECT_EQ(optimised(before, kShort).count().calls, before.count().calls) << seed;
    const Trace after = to_trace(to_network(before), before);
    EXPECT_LT(exact_difference(exact_outputs(before, 7), exact_outputs(after, 7)), kExact) << seed;
  }
}

TEST_F(PassesTest, WhatACallReadsIsShortenedToo) {
  const GiNaC::ex sum = input_[0] * input_[1] + input_[0] * input_[2];
  trace_.output("y", 0, assign_calls(trace_, "c", GiNaC::exp(sum) * input_[3]));
  trace_.output("y", 1, sum + input_[4]);
  expect_operations(4);  // a * (b + c); exp * d; + e
}

TEST_F(PassesTest, NetworkAndBackKeepsValuesAndCount) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Trace before = random_trace(&inputs_, input_, seed);
    const Trace after = to_trace(to_network(before), before);
    EXPECT_LE(after.count().total() + after.count().divisions,
              before.count().total() + before.count().divisions)
        << seed;
    EXPECT_LT(exact_difference(exact_outputs(before, 7), exact_outputs(after, 7)), kExact) << seed;
  }
}

TEST_F(PassesTest, ParametersAreFoldedOnceForAllFunctions) {
  std::vector<GiNaC::ex> chi;
  for (int i = 0; i < 4; ++i) {
    SymbolInfo info;
    info.name = "P" + std::to_string(i + 1);
    info.kind = SymbolKind::kParameter;
    info.array = "chi";
    info.index = i;
    chi.push_back(inputs_.add(std::move(info)));
  }
  const GiNaC::ex l = add_constant(inputs_, "l", GiNaC::numeric(1, 3));
  const GiNaC::ex difference = trace_.assign("d", chi[0] - chi[1]);
  trace_.output("y", 0, difference * input_[0] + chi[2] * input_[1] + l * chi[2] * input_[1]);
  Trace second(&inputs_);
  second.output("z", 0, chi[1] * input_[2] - chi[0] * input_[2] + chi[3] * input_[0] + chi[0]);
  second.output("z", 1, input_[0] / (chi[2] + l * chi[3]));
  const std::vector<Trace> before = {trace_, second};
  expect_folded(before, inputs_);
  const FoldedFunctions folded = fold_parameters(before, inputs_);
  // P1 - P2; P3 (1 + l); P4; P1; 1 / (P3 + l P4)
  EXPECT_EQ(folded.names.size(), 5U);
  EXPECT_EQ(folded.functions[0].count().total(), 3);
  EXPECT_EQ(folded.functions[1].count().total(), 5);
}

TEST_F(PassesTest, SearchFindsWhatNamingDivisorsDoesNot) {
  // (a + b) c + (a + b) d is written as two sums of one factor each
  const GiNaC::ex s = trace_.assign("s", input_[0] * input_[2] + input_[1] * input_[3]);
  const GiNaC::ex t = trace_.assign("t", input_[1] * input_[2] + input_[0] * input_[3]);
  trace_.output("y", 0, trace_.assign("u", s + t));
  EXPECT_EQ(optimised(trace_).count().total(), 3);
}

struct RobotCase {
  std::string name;
  std::string robot;
  GeneratorOptions options;
};

std::vector<RobotCase> robot_cases() {
  const std::filesystem::path root = DYNGEN_SOURCE_DIR;
  std::vector<std::string> robots;
  for (const char* folder : {"robots", "tests/robots"}) {
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      if (entry.path().extension() != ".robot") continue;
      robots.push_back(std::filesystem::relative(entry.path(), root).string());
    }
  }
  std::sort(robots.begin(), robots.end());
  GeneratorOptions baked, runtime, standard;
  runtime.parameters = standard.parameters = ParameterMode::kRuntime;
  standard.regroup = false;
  standard.gravity = standard.wrench = standard.payload = true;
  std::vector<RobotCase> cases;
  for (const std::string& robot : robots) {
    const std::string stem = std::filesystem::path(robot).stem().string();
    cases.push_back({stem + "_baked", robot, baked});
    cases.push_back({stem + "_runtime", robot, runtime});
    cases.push_back({stem + "_standard", robot, standard});
  }
  return cases;
}

class PassesOnRobot : public testing::TestWithParam<RobotCase> {};

TEST_P(PassesOnRobot, EveryFunctionKeepsItsValues) {
  const CodeModel code = make_code_model(read_model(GetParam().robot), GetParam().options);
  for (const FunctionSpec& spec : function_catalogue()) {
    if (spec.why_absent != nullptr && !spec.why_absent(code).empty()) continue;
    expect_kept(write_plain_function({&spec}, code).trace, std::string(spec.name));
  }
}

TEST_P(PassesOnRobot, FoldedFunctionsKeepTheirValues) {
  CodeModel code = make_code_model(read_model(GetParam().robot), GetParam().options);
  std::vector<Trace> functions;
  for (const FunctionSpec& spec : function_catalogue()) {
    if (spec.why_absent != nullptr && !spec.why_absent(code).empty()) continue;
    functions.push_back(write_plain_function({&spec}, code).trace);
  }
  expect_folded(functions, code.inputs);
}

INSTANTIATE_TEST_SUITE_P(Robots, PassesOnRobot, testing::ValuesIn(robot_cases()),
                         [](const auto& entry) { return entry.param.name; });

}  // namespace
}  // namespace dyngen::test
