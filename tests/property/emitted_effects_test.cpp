// SPDX-License-Identifier: MIT
// Many effects in one robot: compiled against evaluated in every mode, the same text every time,
// batches.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/compiled_model.h"
#include "tests/support/effect_arm.h"
#include "tests/support/relative_error.h"
#include "tests/support/shared_object.h"

namespace dyngen::test {
namespace {

struct EmittedCase {
  std::string name;
  const char* rows;
  GeneratorOptions options;
  std::string flags = "-std=c99 -O2 -ffp-contract=off";
  std::string compiler = "cc";
  double tolerance = 4e-15;  ///< sines of the code and of the library differ in the last bit
};

std::vector<EmittedCase> emitted_cases() {
  GeneratorOptions baked;
  baked.functions = {"id", "friction", "effects"};
  GeneratorOptions runtime = baked, single = baked, folded = baked, standard = baked;
  runtime.parameters = standard.parameters = ParameterMode::kRuntime;
  single.scalar = Scalar::kFloat;
  folded.parameters = ParameterMode::kRuntime;
  folded.fold = true;
  standard.regroup = false;
  standard.gravity = standard.wrench = standard.payload = true;
  const std::string cpp = "-std=c++20 -O2 -ffp-contract=off", c = "-std=c99 -O2 -ffp-contract=off";
  std::vector<EmittedCase> cases;
  for (const bool stateful : {false, true}) {
    const std::string name = stateful ? "stateful_" : "algebraic_";
    const char* rows = stateful ? kStatefulRows : kAlgebraicRows;
    cases.push_back({name + "baked", rows, baked});
    cases.push_back({name + "runtime", rows, runtime});
    cases.push_back({name + "folded", rows, folded});
    cases.push_back({name + "standard", rows, standard});
    cases.push_back({name + "cpp", rows, baked, cpp, "c++"});
    cases.push_back({name + "clang", rows, runtime, c, "clang"});
    // some hundred operations at 6e-8 each, slopes of 1/zs
    cases.push_back({name + "float", rows, single, c, "cc", 2e-4});
  }
  return cases;
}

class Emitted : public testing::TestWithParam<EmittedCase> {};

TEST_P(Emitted, CompiledIsEvaluated) {
  const EmittedCase& own = GetParam();
  const RobotModel model = arm_with(own.rows);
  const CompiledModel compiled(model, own.options, own.flags, own.compiler);
  const EvaluatedModel evaluated(model, own.options);
  std::vector<MotionSample> samples = arm_motion();
  const std::vector<MotionSample> random = random_samples(2, kArmSamples, 3);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].gravity = random[k].gravity;
    samples[k].wrench = random[k].wrench;
    samples[k].payload = random[k].payload;
  }
  const bool stateful = own.rows == kStatefulRows;
  for (const std::string& function : own.options.functions) {
    RelativeError error;
    EffectState in_c = stateful ? compiled.new_state(kArmPeriod) : EffectState();
    EffectState state = evaluated.new_state(kArmPeriod);
    for (const MotionSample& sample : samples) {
      error.add(stateful ? compiled.advance(function, sample, evaluated.chi(), in_c)
                         : compiled.call(function, sample, evaluated.chi()),
                evaluated_call(evaluated, function, sample, state));
    }
    EXPECT_LT(error.value(), own.tolerance) << function;
  }
}

// GiNaC's order of terms changes with the addresses of symbols, which are new each time.
TEST_P(Emitted, TextIsTheSameEveryTime) {
  const EmittedCase& own = GetParam();
  GeneratorOptions options = with_short_search(own.options);
  options.cpp_wrapper = true;
  const CText first = generate(arm_with(own.rows), options);
  for (int run = 2; run <= 5; ++run) {
    const CText again = generate(arm_with(own.rows), options);
    EXPECT_EQ(first.source, again.source);
    EXPECT_EQ(first.header, again.header);
    EXPECT_EQ(first.wrapper, again.wrapper);
  }
}

INSTANTIATE_TEST_SUITE_P(effects, Emitted, testing::ValuesIn(emitted_cases()),
                         [](const auto& own) { return own.param.name; });

TEST(EffectBatch, GivesTheBitsOfOneSample) {
  GeneratorOptions options;
  options.functions = {"id", "id_batch", "effects", "effects_batch"};
  options.trig = Trig::kLibm;
  for (const Scalar scalar : {Scalar::kDouble, Scalar::kFloat}) {
    options.scalar = scalar;
    for (const char* flags : {"-std=c99 -O1", "-std=c99 -O1 -mavx2"}) {
      const RobotModel model = arm_with(kAlgebraicRows);
      const CText text = generate(model, with_short_search(options));
      const SharedObject library({{"planar2r.h", text.header}, {"planar2r.c", text.source}}, flags);
      const std::vector<MotionSample> samples = arm_motion(21);
      const auto compare = [&](auto zero) {
        using T = decltype(zero);
        const std::size_t n = samples.size();
        std::vector<T> q(2 * n), dq(2 * n), ddq(2 * n), tau(2 * n), chi(12, T(0.25));
        for (std::size_t k = 0; k < n; ++k) {
          for (std::size_t i = 0; i < 2; ++i) {
            q[i * n + k] = static_cast<T>(samples[k].q[i]);
            dq[i * n + k] = static_cast<T>(samples[k].dq[i]);
            ddq[i * n + k] = static_cast<T>(samples[k].ddq[i]);
          }
        }
        for (const std::string name : {"id", "effects"}) {
          using Batch = void (*)(std::size_t, const T*, const T*, const T*, const T*, T*);
          using One = void (*)(const T*, const T*, const T*, const T*, T*);
          reinterpret_cast<Batch>(library.symbol("planar2r_" + name + "_batch"))(
              n, q.data(), dq.data(), ddq.data(), chi.data(), tau.data());
          const auto one = reinterpret_cast<One>(library.symbol("planar2r_" + name));
          for (std::size_t k = 0; k < n; ++k) {
            const T own_q[2] = {q[k], q[n + k]}, own_dq[2] = {dq[k], dq[n + k]};
            const T own_ddq[2] = {ddq[k], ddq[n + k]};
            T own[2] = {};
            one(own_q, own_dq, own_ddq, chi.data(), own);
            for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(tau[i * n + k], own[i]) << name << k;
          }
        }
      };
      if (scalar == Scalar::kDouble) {
        compare(0.0);
      } else {
        compare(0.0F);
      }
    }
  }
}

}  // namespace
}  // namespace dyngen::test
