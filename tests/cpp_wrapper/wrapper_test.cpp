// SPDX-License-Identifier: MIT
// The C++ header of --cpp-wrapper: every function of the catalogue gives through it what the C
// function gives, bit by bit and element by element.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "gen/emit_cpp/emit_cpp.h"
#include "tests/support/model_bridge.h"
#include "tests/support/shared_object.h"

namespace dyngen::test {
namespace {

constexpr int kBatch = 11;  // samples: no multiple of what a register holds

/// The same for the batches, of kBatch samples; arrays as the C functions have them.
std::string batch_shim_text(CodeModel code, const GeneratorOptions& options) {
  std::string text;
  for (const RobotFunction& function : write_functions(code, options)) {
    if (!function.batch) continue;
    const std::string name = function.name + "_batch";
    std::string conversions, passed, direct, copies;
    int inputs = 0;
    for (const Argument& argument : arguments(*function.spec, code)) {
      if (argument.output) continue;
      conversions += fmt::format(
          "  const Eigen::Matrix<Scalar, {0}, {1}> x{2} = "
          "Eigen::Map<const Eigen::Matrix<Scalar, {0}, {1}>>(in[{2}]{3});\n",
          argument.shared ? fmt::to_string(argument.size()) : "Eigen::Dynamic",
          argument.shared ? 1 : argument.size(), inputs,
          argument.shared ? "" : fmt::format(", {}, {}", kBatch, argument.size()));
      passed += fmt::format("{}x{}", inputs == 0 ? "" : ", ", inputs);
      direct += fmt::format(", in[{}]", inputs);
      ++inputs;
    }
    const std::vector<OutputSpec>& outputs = function.spec->outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const std::string place =
          outputs.size() > 1 ? "y." + std::string(outputs[i].array) : std::string("y");
      // element e of sample k at e * n + k: column by column
      copies += fmt::format("  put({}.transpose(), out[{}]);\n", place, i);
      direct += fmt::format(", out[{}]", i);
    }
    const auto head = [&](const std::string& kind) {
      return fmt::format(
          "extern \"C\" void {0}_{1}(const Scalar* const* in, Scalar* const* out);\n"
          "void {0}_{1}(const Scalar* const* in, Scalar* const* out) {{\n",
          kind, name);
    };
    text += head("wrapped") + conversions;
    text += fmt::format("  const auto y = model::{}({});\n{}}}\n", name, passed, copies);
    text += head("direct") + fmt::format("  model_{}({}{});\n}}\n", name, kBatch, direct);
  }
  return text;
}

/// Two C functions for each of the model's, of the same signature: wrapped_ calls the wrapper and
/// writes its results row by row, direct_ calls the C function.
std::string shim_text(CodeModel code, const GeneratorOptions& options) {
  std::string text =
      "#include \"model.hpp\"\n"
      "namespace {\n"
      "using model::Isometry, model::Scalar;\n"
      "template <class M> void put(const M& m, Scalar* to) {\n"
      "  for (Eigen::Index i = 0; i < m.rows(); ++i) {\n"
      "    for (Eigen::Index k = 0; k < m.cols(); ++k) *to++ = m(i, k);\n"
      "  }\n"
      "}\n"
      "[[maybe_unused]] void put(const Isometry& T, Scalar* to) { put(T.matrix(), to); }\n"
      "}  // namespace\n";
  for (const RobotFunction& function : write_functions(code, options)) {
    const FunctionSpec& spec = *function.spec;
    const auto head = [&](const std::string& kind) {
      const std::string declaration = fmt::format(
          "void {}_{}(const Scalar* const* in, Scalar* const* out)", kind, function.name);
      return fmt::format("extern \"C\" {0};\n{0} {{\n", declaration);
    };
    text += head("wrapped");
    std::string passed, direct;
    int inputs = 0;
    for (const Argument& argument : arguments(spec, code)) {
      if (argument.output) continue;
      text += fmt::format(
          "  const Eigen::Matrix<Scalar, {0}, 1> x{1} = Eigen::Map<const Eigen::Matrix<Scalar, "
          "{0}, "
          "1>>(in[{1}]);\n",
          argument.size(), inputs);
      passed += fmt::format("{}x{}", inputs == 0 ? "" : ", ", inputs);
      direct += fmt::format("in[{}], ", inputs);
      ++inputs;
    }
    text += fmt::format("  static_assert(noexcept(model::{}({})));\n", function.name, passed);
    text += fmt::format("  const auto y = model::{}({});\n", function.name, passed);
    for (std::size_t i = 0; i < spec.outputs.size(); ++i) {
      text += spec.outputs.size() > 1
                  ? fmt::format("  put(y.{}, out[{}]);\n", spec.outputs[i].array, i)
                  : fmt::format("  put(y, out[{}]);\n", i);
      direct += fmt::format("{}out[{}]", i > 0 ? ", " : "", i);
    }
    text += "}\n" + head("direct") + fmt::format("  model_{}({});\n}}\n", function.name, direct);
  }
  text += batch_shim_text(code, options);
  // the tables, and that all of this is known to the compiler
  text += fmt::format(
      "static_assert(model::Sizes::nq == {} && model::Sizes::nchi == {} && "
      "model::Sizes::nbeta == {});\n"
      "static_assert(model::joint_names.size() == {} && model::joint_names[0] == \"{}\");\n"
      "static_assert(model::chi_names.size() == {} && model::beta_names.size() == {});\n",
      code.coordinate_names.size(), code.chi.size(), code.beta.size(), code.coordinate_names.size(),
      code.coordinate_names[0], code.chi.size(), code.beta.size());
  if (!code.chi.empty()) {
    text += fmt::format("static_assert(model::chi_names[0] == \"{}\");\n", code.chi[0].name);
    text +=
        "extern \"C\" void wrapped_chi_values(Scalar* out);\n"
        "void wrapped_chi_values(Scalar* out) { put(model::chi_values(), out); }\n";
  }
  return text;
}

struct WrapperCase {
  std::string name;
  RobotModel model;
  GeneratorOptions options;
};

void PrintTo(const WrapperCase& wrapper_case, std::ostream* out) { *out << wrapper_case.name; }

GeneratorOptions options_of(const WrapperCase& wrapper_case) {
  GeneratorOptions options = with_short_search(wrapper_case.options);
  options.prefix = "model";
  options.cpp_wrapper = true;
  return options;
}

/// The shim and the model as one C++ program.
template <class T>
class Wrapped {
 public:
  Wrapped(const CText& text, const CodeModel& code, const GeneratorOptions& options,
          const std::string& compiler)
      : code_(code),
        library_({{"model.h", text.header},
                  {"model.hpp", text.wrapper},
                  {"model.cpp", text.source},
                  {"shim.cpp", shim_text(code, options)}},
                 "-std=c++20 -O1 -ffp-contract=off -isystem " DYNGEN_EIGEN_INCLUDE, compiler) {}

  /// @param kind  "wrapped" or "direct"
  [[nodiscard]] std::vector<std::vector<T>> call(const std::string& kind,
                                                 const RobotFunction& function,
                                                 const MotionSample& sample,
                                                 const std::vector<double>& chi,
                                                 bool batch = false) const {
    std::vector<std::vector<T>> in, out;
    for (const Argument& argument : arguments(*function.spec, code_)) {
      const int samples = batch && !argument.shared ? kBatch : 1;
      if (argument.output) {
        out.emplace_back(static_cast<std::size_t>(argument.size() * samples), T(-77));
        continue;
      }
      const std::vector<double> folded(static_cast<std::size_t>(argument.size()), 0.7);
      const std::vector<double>& values = argument.name == "chi"      ? chi
                                          : argument.name == "folded" ? folded
                                                                      : sample.input(argument.name);
      std::vector<T>& array = in.emplace_back();
      for (const double value : values) {
        for (int k = 0; k < samples; ++k) array.push_back(static_cast<T>(value + 0.1 * k));
      }
    }
    std::vector<const T*> inputs;
    std::vector<T*> outputs;
    for (const std::vector<T>& array : in) inputs.push_back(array.data());
    for (std::vector<T>& array : out) outputs.push_back(array.data());
    using Function = void (*)(const T* const*, T* const*);
    reinterpret_cast<Function>(library_.symbol(
        kind + "_" + function.name + (batch ? "_batch" : "")))(inputs.data(), outputs.data());
    return out;
  }
  [[nodiscard]] std::vector<double> chi_values() const {
    std::vector<T> values(code_.chi.size());
    reinterpret_cast<void (*)(T*)>(library_.symbol("wrapped_chi_values"))(values.data());
    return {values.begin(), values.end()};
  }

 private:
  const CodeModel& code_;
  SharedObject library_;
};

/// How many functions give something else through the wrapper.
template <class T>
int differences_as(const WrapperCase& wrapper_case, const CText& text,
                   const std::string& compiler) {
  const GeneratorOptions options = options_of(wrapper_case);
  const EvaluatedModel evaluated(wrapper_case.model, with_random_values(wrapper_case.model, 5),
                                 options);
  const Wrapped<T> wrapped(text, evaluated.code(), options, compiler);
  int different = 0;
  for (const RobotFunction& function : evaluated.functions()) {
    bool equal = true;
    for (const MotionSample& sample : random_samples(wrapper_case.model.coordinate_count, 4, 8)) {
      for (const bool batch : {false, true}) {
        if (batch && !function.batch) continue;
        equal = equal && wrapped.call("wrapped", function, sample, evaluated.chi(), batch) ==
                             wrapped.call("direct", function, sample, evaluated.chi(), batch);
      }
    }
    different += equal ? 0 : 1;
  }
  if (!evaluated.code().chi.empty()) {
    const std::vector<double> written = wrapped.chi_values();
    for (std::size_t i = 0; i < written.size(); ++i) {
      const ChiEntry& entry = evaluated.code().chi[i];
      EXPECT_EQ(std::isnan(written[i]), !entry.value.has_value()) << entry.name;
      if (!entry.value) continue;
      EXPECT_EQ(written[i], static_cast<T>(evaluated.chi()[i])) << entry.name;
    }
  }
  return different;
}

int differences(const WrapperCase& wrapper_case, const CText& text, const std::string& compiler) {
  return wrapper_case.options.scalar == Scalar::kFloat
             ? differences_as<float>(wrapper_case, text, compiler)
             : differences_as<double>(wrapper_case, text, compiler);
}

CText text_of(const WrapperCase& wrapper_case) {
  return generate(wrapper_case.model, options_of(wrapper_case));
}

WrapperCase pendulum() { return {"PendulumBaked", read_model("tests/robots/pendulum.robot"), {}}; }

std::vector<WrapperCase> cases() {
  GeneratorOptions arguments;
  arguments.parameters = ParameterMode::kRuntime;
  arguments.gravity = arguments.wrench = arguments.payload = true;
  arguments.functions = {kAllFunctions};  // batches too
  GeneratorOptions single;
  single.scalar = Scalar::kFloat;
  GeneratorOptions folded;
  folded.parameters = ParameterMode::kRuntime;
  folded.fold = true;
  folded.functions = {"id", "id_batch", "id_derivatives", "fk"};
  GeneratorOptions standard;
  standard.regroup = false;
  const RobotModel tree = parse_model(
      "name tree\nnumber_link 4\nsigma 0 1 2 0\nant 0 1 1 3\nal 0 pi/2 0.3 -pi/2\nd 0 * 0.2 0.1\n"
      "th 0 0 0.4 0\nr 0.3 0 * 0\nm * * 1 *\nmX * 0.2 0.1 *\nZZ 1 * 0.3 *\nIA 0.1 * 0 *\n"
      "Fs 0.1 * 0 0\ngz 9.81\nstop\n");
  return {pendulum(),
          {"PrismaticWithAllArguments", read_model("tests/robots/rp.robot"), arguments},
          {"PumaFloat", read_model("robots/puma560.robot"), single},
          {"TreeOfUnknowns", tree, standard},
          {"TreeFolded", tree, folded}};
}

class CppWrapper : public testing::TestWithParam<std::tuple<WrapperCase, std::string>> {};

TEST_P(CppWrapper, EveryFunctionGivesTheNumbersOfTheCFunction) {
  const auto& [wrapper_case, compiler] = GetParam();
  EXPECT_EQ(differences(wrapper_case, text_of(wrapper_case), compiler), 0);
}

std::vector<std::string> compilers() {
  std::stringstream list(DYNGEN_TEST_CXX);
  std::vector<std::string> result;
  for (std::string compiler; std::getline(list, compiler, ',');) result.push_back(compiler);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Cases, CppWrapper,
                         testing::Combine(testing::ValuesIn(cases()),
                                          testing::ValuesIn(compilers())),
                         [](const auto& parameters) {
                           const bool clang =
                               std::get<1>(parameters.param).find("clang") != std::string::npos;
                           return std::get<0>(parameters.param).name + (clang ? "Clang" : "Gcc");
                         });

TEST(CppWrapperText, ComparisonFailsOnSwappedArguments) {
  CText text = text_of(pendulum());
  const std::string right = "q.data(), dq.data()";
  const std::size_t place = text.wrapper.find(right);
  ASSERT_NE(place, std::string::npos);
  text.wrapper.replace(place, right.size(), "dq.data(), q.data()");
  EXPECT_EQ(differences(pendulum(), text, compilers()[0]), 1);  // in id, the first of them
}

TEST(CppWrapperText, BatchesCheckTheirNumbersOfSamples) {
  GeneratorOptions options = options_of(pendulum());
  options.functions = {"id", "id_batch"};
  const std::string text = generate(pendulum().model, options).wrapper;
  EXPECT_NE(text.find("check_samples(\"id_batch(): dq\", dq.rows(), samples);"), std::string::npos);
  EXPECT_NE(text.find("check_samples(\"id_batch(): ddq\", ddq.rows(), samples);"),
            std::string::npos);
}

TEST(CppWrapperText, ItIsWrittenOnlyOnRequest) {
  EXPECT_TRUE(generate(pendulum().model, {}).wrapper.empty());
}

TEST(CppWrapperText, ResultsTooLargeForTheStackAreOnTheHeap) {
  const CodeModel small = make_code_model(pendulum().model, {});
  const std::vector<RobotFunction> functions = {
      write_plain_function(parse_function_name("gravity_regressor"), small)};
  const auto declares = [&](std::size_t size, Scalar scalar, const std::string& result,
                            const std::string& end) {
    CodeModel code = small;
    code.coordinate_names.assign(size, "joint");
    code.beta.assign(size, "ZZ");
    EmitOptions options;
    options.prefix = "model";
    options.scalar = scalar;
    return emit_cpp(code, functions, options)
               .find(fmt::format("inline {} gravity_regressor(const Vector& q){}", result, end)) !=
           std::string::npos;
  };
  EXPECT_TRUE(declares(128, Scalar::kDouble, "Matrix<NQ, NBETA>", " noexcept {"));  // 128 KiB
  EXPECT_TRUE(declares(129, Scalar::kDouble, "LargeMatrix", " {"));
  EXPECT_TRUE(declares(129, Scalar::kFloat, "Matrix<NQ, NBETA>", " noexcept {"));
}

TEST(CppWrapperText, StatesOfEffectsAreTakenByReference) {
  GeneratorOptions options;
  options.functions = {"id"};
  options.cpp_wrapper = true;
  options.prefix = "arm";
  const CText text =
      generate(read_model("tests/robots/effects/stateful_arm.robot"), with_short_search(options));
  // the same calls through both: bit by bit
  const std::string shim =
      "#include \"arm.hpp\"\n"
      "extern \"C\" int same() {\n"
      "  arm::State s = arm::new_state(0.001);\n"
      "  arm_state own;\n"
      "  arm_reset(&own, 0.001);\n"
      "  for (int k = 0; k < 50; ++k) {\n"
      "    const arm::Vector q(0.1, 0.2), dq(0.3 - 0.01 * k, 0.02 * k), ddq(0.0, 1.0);\n"
      "    arm::Vector tau;\n"
      "    arm_id(&own, q.data(), dq.data(), ddq.data(), tau.data());\n"
      "    if (tau != arm::id(s, q, dq, ddq)) return 0;\n"
      "  }\n"
      "  return s.z[0] == own.z[0] && s.z[0] != 0.0;\n"
      "}\n";
  const SharedObject library({{"arm.h", text.header},
                              {"arm.hpp", text.wrapper},
                              {"arm.c", text.source},
                              {"shim.cpp", shim}},
                             "-O1 -isystem " DYNGEN_EIGEN_INCLUDE, "c++ -x c++ -std=c++20");
  EXPECT_EQ(reinterpret_cast<int (*)()>(library.symbol("same"))(), 1);
}

TEST(CppWrapperText, NamesThatNoNamespaceMayHaveAreRefused) {
  GeneratorOptions options;
  options.cpp_wrapper = true;
  for (const std::string prefix : {"std", "Eigen", "class", "double", "xor_eq", "int"}) {
    options.prefix = prefix;
    EXPECT_THROW(static_cast<void>(generate(pendulum().model, options)), ModelError) << prefix;
  }
  options.prefix = "classic";
  EXPECT_NO_THROW(static_cast<void>(generate(pendulum().model, options)));
}

}  // namespace
}  // namespace dyngen::test
