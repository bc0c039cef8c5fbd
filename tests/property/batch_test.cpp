// SPDX-License-Identifier: MIT
// Functions over many samples give the bits of the functions over one, for any number of samples.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/support/model_bridge.h"
#include "tests/support/shared_object.h"

namespace dyngen::test::batch_tests {
namespace {

// No sample, less than a register of any width, exactly one, many and some more.
constexpr std::size_t kSampleCounts[] = {0, 1, 2, 3, 5, 8, 16, 17, 64, 131};

struct BatchCase {
  std::string name;
  std::string robot;
  GeneratorOptions options;
  std::string flags;
};

std::vector<BatchCase> cases() {
  const std::string plain = "-std=c99 -O1", avx = "-std=c99 -O1 -mavx2";
  GeneratorOptions baked;
  baked.functions = {kAllFunctions};
  GeneratorOptions few = baked;
  few.functions = {"id", "id_batch", "gravity", "gravity_batch"};
  few.parameters = ParameterMode::kRuntime;
  GeneratorOptions runtime = baked;
  runtime.parameters = ParameterMode::kRuntime;
  runtime.gravity = runtime.wrench = runtime.payload = true;
  GeneratorOptions folded = few;
  folded.fold = true;
  GeneratorOptions standard = runtime;
  standard.regroup = false;
  GeneratorOptions single = baked, single_runtime = runtime, libm = baked;
  single.scalar = single_runtime.scalar = Scalar::kFloat;
  libm.trig = Trig::kLibm;
  return {{"planar2r_baked", "robots/planar2r.robot", baked, plain},
          {"planar2r_without_vectors", "robots/planar2r.robot", runtime, plain + " -DNO_VECTORS"},
          {"rp_runtime", "tests/robots/rp.robot", runtime, plain},
          {"rp_standard_libm", "tests/robots/rp.robot", standard, plain},
          {"flip3r_libm", "tests/robots/flip3r.robot", libm, plain},
          {"scara_float", "robots/scara.robot", single, plain},
          {"rp_float_runtime", "tests/robots/rp.robot", single_runtime, plain},
          {"puma560_runtime", "robots/puma560.robot", few, plain},
          {"puma560_folded", "robots/puma560.robot", folded, plain},
          {"sarcos_avx2", "robots/sarcos_grla.robot", few, avx},
          {"scara_float_avx2", "robots/scara.robot", single, avx}};
}

/// "a[0], a[1]": the arguments as elements of one array of pointers.
std::string pointers(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}a[{}]", i > 0 ? ", " : "", i);
  return text;
}

/// A compiled model whose functions are called through one signature.
class BatchModel {
 public:
  BatchModel(const RobotModel& model, const BatchCase& batch_case)
      : code_(make_code_model(model, batch_case.options)),
        functions_(write_functions(code_, batch_case.options)),
        library_(files(model, batch_case.options), flags(batch_case.flags)) {}

  [[nodiscard]] const CodeModel& code() const { return code_; }
  [[nodiscard]] const std::vector<RobotFunction>& functions() const { return functions_; }

  template <class T>
  void call(const FunctionSpec& spec, std::size_t n, std::vector<T*> a, bool batch) const {
    const std::string name = fmt::format("call_{}{}", spec.name, batch ? "_batch" : "");
    reinterpret_cast<void (*)(std::size_t, T**)>(library_.symbol(name))(n, a.data());
  }

 private:
  std::map<std::string, std::string> files(const RobotModel& model, GeneratorOptions options) {
    options.prefix = "robot";
    CText text = generate(model, options);
    const std::string scalar = options.scalar == Scalar::kDouble ? "double" : "float";
    std::string calls;
    for (const RobotFunction& function : functions_) {
      if (!function.batch) continue;
      const std::size_t count = arguments(*function.spec, code_).size();
      calls += fmt::format(
          "\nvoid call_{0}(size_t n, {1} **a);\nvoid call_{0}_batch(size_t n, {1} **a);\n"
          "void call_{0}(size_t n, {1} **a) {{\n  (void)n;\n  robot_{0}({2});\n}}\n"
          "void call_{0}_batch(size_t n, {1} **a) {{\n  robot_{0}_batch(n, {2});\n}}\n",
          function.spec->name, scalar, pointers(count));
    }
    return {{"robot.h", text.header},
            {"robot.c", hide_vectors(text.source)},
            {"calls.c", "#include \"robot.h\"\n" + calls}};
  }
  /// So that -DNO_VECTORS stands for a compiler without them.
  static std::string hide_vectors(std::string source) {
    const std::string gnu = "defined(__GNUC__)";
    const std::size_t at = source.find(gnu);
    return at == std::string::npos
               ? source
               : source.replace(at, gnu.size(), gnu + " && !defined(NO_VECTORS)");
  }
  /// Contraction to fused operations could differ between the two functions.
  static std::string flags(const std::string& wanted) { return wanted + " -ffp-contract=off"; }

  CodeModel code_;
  std::vector<RobotFunction> functions_;
  SharedObject library_;
};

/// Inputs in +-3, all of the same kind for all samples; a few angles are far away.
template <class T>
std::vector<T> input_values(const Argument& argument, std::size_t samples,
                            const std::vector<double>& chi, std::mt19937_64& random) {
  std::vector<T> values;
  if (argument.name == "chi") return {chi.begin(), chi.end()};
  const std::size_t size = static_cast<std::size_t>(argument.size());
  for (std::size_t i = 0; i < size * (argument.shared ? 1 : samples); ++i) {
    const bool far = argument.name == "q" && random() % 40 == 0;
    values.push_back(
        static_cast<T>((far ? 1e6 : 3.0) * std::uniform_real_distribution<double>(-1, 1)(random)));
  }
  return values;
}

template <class T>
void compare(const BatchModel& model, const std::vector<double>& chi) {
  std::mt19937_64 random(17);
  constexpr T kUntouched = T(-77.25);
  for (const RobotFunction& function : model.functions()) {
    if (!function.batch) continue;
    const std::vector<Argument> all = arguments(*function.spec, model.code());
    for (const std::size_t n : kSampleCounts) {
      SCOPED_TRACE(fmt::format("{}, {} samples", function.spec->name, n));
      std::vector<std::vector<T>> arrays;
      std::vector<T*> whole;
      for (const Argument& argument : all) {
        const std::size_t size = static_cast<std::size_t>(argument.size());
        arrays.push_back(argument.output ? std::vector<T>(size * n + 1, kUntouched)
                                         : input_values<T>(argument, n, chi, random));
      }
      for (std::vector<T>& array : arrays) whole.push_back(array.data());
      model.call(*function.spec, n, whole, true);

      for (std::size_t k = 0; k < n; ++k) {
        std::vector<std::vector<T>> one;
        std::vector<T*> single;
        for (std::size_t i = 0; i < all.size(); ++i) {
          one.emplace_back(static_cast<std::size_t>(all[i].size()));
          for (std::size_t e = 0; e < one[i].size(); ++e) {
            one[i][e] = all[i].output ? 0 : all[i].shared ? arrays[i][e] : arrays[i][e * n + k];
          }
        }
        for (std::vector<T>& array : one) single.push_back(array.data());
        model.call(*function.spec, n, single, false);
        for (std::size_t i = 0; i < all.size(); ++i) {
          if (!all[i].output) continue;
          for (std::size_t e = 0; e < one[i].size(); ++e) {
            ASSERT_EQ(std::memcmp(&arrays[i][e * n + k], &one[i][e], sizeof(T)), 0)
                << all[i].name << "[" << e << "] of sample " << k << ": " << arrays[i][e * n + k]
                << " and " << one[i][e];
          }
        }
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].output) continue;
        EXPECT_EQ(arrays[i].back(), kUntouched) << all[i].name;
      }
    }
  }
}

class Batch : public testing::TestWithParam<BatchCase> {};

TEST_P(Batch, GivesTheBitsOfOneSampleAfterTheOther) {
  const RobotModel model = read_model(GetParam().robot);
  const BatchModel compiled(model, GetParam());
  const EvaluatedModel values(model, with_random_values(model, 7), GetParam().options);
  if (GetParam().options.scalar == Scalar::kFloat) {
    compare<float>(compiled, values.chi());
  } else {
    compare<double>(compiled, values.chi());
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Batch, testing::ValuesIn(cases()),
                         [](const auto& entry) { return entry.param.name; });

TEST(BatchFunctions, AreWrittenWhenNamed) {
  const RobotModel model = read_model("robots/planar2r.robot");
  GeneratorOptions options;
  EXPECT_EQ(generate(model, options).source.find("_batch"), std::string::npos);
  options.functions = {"gravity_batch"};
  const CText text = generate(model, options);
  EXPECT_NE(text.header.find("void planar2r_gravity_batch(size_t n"), std::string::npos);
  EXPECT_EQ(text.header.find("planar2r_gravity("), std::string::npos);
  options.functions = {"gravity_batch_batch"};
  EXPECT_THROW(generate(model, options), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test::batch_tests
