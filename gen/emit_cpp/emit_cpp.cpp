// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_cpp/emit_cpp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "gen/diagnostic/diagnostic.h"
#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/function_text.h"
#include "gen/emit_c/state_text.h"

namespace dyngen {
namespace {

/// What no namespace may be called: C++20's words that C allows as a prefix, and names in use here.
void check_namespace(const CodeModel& code, const std::string& prefix) {
  static const std::vector<std::string_view> kTaken = {
      "Eigen",      "alignas",      "alignof",       "and",
      "and_eq",     "asm",          "auto",          "bitand",
      "bitor",      "bool",         "break",         "case",
      "catch",      "char",         "char16_t",      "char32_t",
      "char8_t",    "class",        "co_await",      "co_return",
      "co_yield",   "compl",        "concept",       "const",
      "const_cast", "consteval",    "constexpr",     "constinit",
      "continue",   "decltype",     "default",       "delete",
      "do",         "double",       "dynamic_cast",  "else",
      "enum",       "explicit",     "export",        "extern",
      "false",      "float",        "for",           "friend",
      "goto",       "if",           "inline",        "int",
      "long",       "mutable",      "namespace",     "new",
      "noexcept",   "not",          "not_eq",        "nullptr",
      "operator",   "or",           "or_eq",         "private",
      "protected",  "public",       "register",      "reinterpret_cast",
      "requires",   "return",       "short",         "signed",
      "sizeof",     "static",       "static_assert", "static_cast",
      "std",        "struct",       "switch",        "template",
      "this",       "thread_local", "throw",         "true",
      "try",        "typedef",      "typeid",        "typename",
      "union",      "unsigned",     "using",         "virtual",
      "void",       "volatile",     "wchar_t",       "while",
      "xor",        "xor_eq"};
  if (std::find(kTaken.begin(), kTaken.end(), prefix) != kTaken.end()) {
    throw ModelError(fmt::format(
        "{}: error: the prefix '{}' cannot name a namespace; choose another one with --prefix\n",
        code.file_name, prefix));
  }
}

/// An output in C++: its type, and how it is made.
struct OutputType {
  std::string type;
  bool isometry = false;
  bool on_heap = false;  ///< too large for the stack
};

std::string extent_text(Extent extent) {
  switch (extent) {
    case Extent::kOne:
      return "1";
    case Extent::kThree:
      return "3";
    case Extent::kFour:
      return "4";
    case Extent::kSix:
      return "6";
    case Extent::kJoints:
      return "NQ";
    case Extent::kChi:
      return "NCHI";
    case Extent::kBeta:
      return "NBETA";
    case Extent::kFolded:
      return "NFOLDED";
  }
  return {};
}

OutputType output_type(const OutputSpec& output, const CodeModel& code, Scalar scalar) {
  // EIGEN_STACK_ALLOCATION_LIMIT: Eigen refuses larger objects of fixed size.
  constexpr int kMostBytes = 128 * 1024;
  const int bytes = extent_size(output.rows, code) * extent_size(output.columns, code) *
                    (scalar == Scalar::kDouble ? 8 : 4);
  if (bytes > kMostBytes) return {"LargeMatrix", false, true};
  if (output.rows == Extent::kFour && output.columns == Extent::kFour) return {"Isometry", true};
  if (output.rows == Extent::kJoints && output.columns == Extent::kOne) return {"Vector"};
  const std::string rows = extent_text(output.rows);
  if (output.rows == Extent::kFolded) return {"Folded"};
  if (output.columns == Extent::kOne) return {fmt::format("Matrix<{}>", rows)};
  return {fmt::format("Matrix<{}, {}>", rows, extent_text(output.columns))};
}

std::string input_type(const Argument& argument, const CodeModel& code) {
  if (argument.name == "chi") return "Chi";
  if (argument.name == "folded") return "Folded";
  const int joints = extent_size(Extent::kJoints, code);
  if (!argument.shared && argument.size() == joints && argument.name != "wrench" &&
      argument.name != "w") {
    return "Vector";
  }
  return fmt::format("Matrix<{}>", argument.size());
}

/// "IdDerivatives" of "id_derivatives".
std::string type_name(std::string_view function) {
  std::string name;
  bool start = true;
  for (const char c : function) {
    if (c != '_')
      name += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    start = c == '_';
  }
  return name;
}

/// The struct that a function with several outputs returns.
std::string output_struct(const RobotFunction& function, const CodeModel& code,
                          const EmitOptions& options) {
  std::string text = fmt::format("/// What {}() returns.\nstruct {} {{\n", function.name,
                                 type_name(function.name));
  for (const OutputSpec& output : function.spec->outputs) {
    const OutputType type = output_type(output, code, options.scalar);
    text += fmt::format("  {} {}", type.type, output.array);
    if (type.on_heap) {
      text += fmt::format("{{{}, {}}}", extent_text(output.rows), extent_text(output.columns));
    }
    text += ";\n";
  }
  return text + "};\n\n";
}

std::string function_text(const RobotFunction& function, const CodeModel& code,
                          const EmitOptions& options) {
  const FunctionSpec& spec = *function.spec;
  const bool several = spec.outputs.size() > 1;
  bool heap = false;
  for (const OutputSpec& output : spec.outputs) {
    heap = heap || output_type(output, code, options.scalar).on_heap;
  }
  const std::string result =
      several ? type_name(function.name) : output_type(spec.outputs[0], code, options.scalar).type;

  std::string parameters, passed, before, after;
  for (const Argument& argument : arguments(spec, code)) {
    if (argument.output) continue;
    if (argument.state) {
      parameters += "State& " + argument.name;
      passed += "&" + argument.name + ", ";
      continue;
    }
    parameters += fmt::format("{}const {}& {}", parameters.empty() ? "" : ", ",
                              input_type(argument, code), argument.name);
    passed += argument.name + ".data(), ";
  }
  if (several) before += fmt::format("  {} out;\n", result);
  for (const OutputSpec& output : spec.outputs) {
    const OutputType type = output_type(output, code, options.scalar);
    const std::string array(output.array);
    const std::string place = several ? "out." + array : array;
    if (type.isometry) {  // the C array is row-major
      const std::string rows = array + "_rows";
      before += fmt::format("  Matrix<4, 4> {};\n", rows);
      if (!several) after += fmt::format("  Isometry {};\n", place);
      after += fmt::format("  {}.matrix() = {};\n", place, rows);
      passed += rows + ".data(), ";
      continue;
    }
    if (!several) {
      before += fmt::format("  {} {}", type.type, array);
      if (type.on_heap) {
        before += fmt::format("({}, {})", extent_text(output.rows), extent_text(output.columns));
      }
      before += ";\n";
    }
    passed += place + ".data(), ";
  }
  passed.resize(passed.size() - 2);
  std::string text = several ? output_struct(function, code, options) : "";
  text += wrap_comment(summary_text(code, function), "/// ", "/// ") + "\n";
  text += wrap_arguments(fmt::format("[[nodiscard]] inline {} {}({}){} {{\n", result, function.name,
                                     parameters, heap ? "" : " noexcept"));
  text += before;
  text += wrap_arguments(fmt::format("  ::{}_{}({});\n", options.prefix, function.name, passed));
  text += after;
  return text +
         fmt::format("  return {};\n}}\n\n", several ? "out" : std::string(spec.outputs[0].array));
}

/// The columns of an array with one row for each sample: "NQ", "NQ * NQ".
std::string batch_columns(const OutputSpec& output) {
  std::string rows = extent_text(output.rows);
  if (output.columns == Extent::kOne) return rows;
  return fmt::format("{} * {}", rows, extent_text(output.columns));
}

/// The function over many samples. Its result is on the heap, and a wrong number of samples is the
/// caller's mistake.
std::string batch_text(const RobotFunction& function, const CodeModel& code,
                       const EmitOptions& options) {
  const FunctionSpec& spec = *function.spec;
  const std::string name = function.name + std::string(kBatchEnding);
  const bool several = spec.outputs.size() > 1;
  const std::string result =
      several ? type_name(name) : fmt::format("Batch<{}>", batch_columns(spec.outputs[0]));

  std::string parameters, passed, checks, first;
  for (const Argument& argument : arguments(spec, code)) {
    if (argument.output) continue;
    std::string type = input_type(argument, code);
    if (!argument.shared) {
      type = type == "Vector" ? "Batch<NQ>" : fmt::format("Batch<{}>", argument.size());
      if (first.empty()) {
        first = argument.name;
      } else {
        checks += fmt::format("  check_samples(\"{}(): {}\", {}.rows(), samples);\n", name,
                              argument.name, argument.name);
      }
    }
    parameters +=
        fmt::format("{}const {}& {}", parameters.empty() ? "" : ", ", type, argument.name);
    passed += argument.name + ".data(), ";
  }
  std::string text;
  if (several) text += fmt::format("/// What {}() returns.\nstruct {} {{\n", name, result);
  std::string outputs;
  for (const OutputSpec& output : spec.outputs) {
    const std::string columns = batch_columns(output);
    if (several) text += fmt::format("  Batch<{}> {};\n", columns, output.array);
    const std::string place = (several ? "out." : "") + std::string(output.array);
    outputs += several ? fmt::format("  {}.resize(samples, {});\n", place, columns)
                       : fmt::format("  {} {}(samples, {});\n", result, place, columns);
    passed += place + ".data(), ";
  }
  passed.resize(passed.size() - 2);
  if (several) {
    text += "};\n\n";
    outputs = fmt::format("  {} out;\n", result) + outputs;
  }
  text += fmt::format("/// {}() of many samples; matrices row by row in their columns.\n",
                      function.name);
  text +=
      wrap_arguments(fmt::format("[[nodiscard]] inline {} {}({}) {{\n", result, name, parameters));
  text += fmt::format("  const Eigen::Index samples = {}.rows();\n", first) + checks + outputs;
  text += wrap_arguments(fmt::format("  ::{}_{}(static_cast<std::size_t>(samples), {});\n",
                                     options.prefix, name, passed));
  return text +
         fmt::format("  return {};\n}}\n\n", several ? "out" : std::string(spec.outputs[0].array));
}

std::string view_table(const std::string& name, const std::vector<std::string>& names) {
  std::string text =
      fmt::format("inline constexpr std::array<std::string_view, {}> {} = {{", names.size(), name);
  std::string line;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string entry = fmt::format("\"{}\"{}", names[i], i + 1 < names.size() ? "," : "");
    constexpr std::size_t kLineWidth = 100;
    if (line.empty() || line.size() + 1 + entry.size() > kLineWidth) {
      text += line.empty() ? "" : "\n" + line;
      line = "    " + entry;
    } else {
      line += " " + entry;
    }
  }
  return text + (line.empty() ? "" : "\n" + line) + "};\n";
}

std::string preamble(const CodeModel& code, const EmitOptions& options, bool batch) {
  const std::string upper = upper_case(options.prefix);
  std::string text = fmt::format(
      "/* Generated by dyngen from {0}.  Do not edit: edit the robot file and run dyngen again.\n"
      " * SPDX-License-Identifier: MIT */\n"
      "#ifndef {1}_HPP\n#define {1}_HPP\n\n"
      "#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <array>\n"
      "{3}#include <string_view>\n\n#include \"{2}\"\n\n",
      std::filesystem::path(code.file_name).filename().string(), upper, options.header_name,
      batch ? "#include <cstddef>\n#include <stdexcept>\n#include <string>\n" : "");
  text += fmt::format(
      "/// The functions of {0} over Eigen's types. Units, argument by argument, and operation\n"
      "/// counts stand there. No function allocates memory unless its return type says so.\n"
      "namespace {1} {{\n\n"
      "/// Numbers of joint coordinates, of parameters in chi, of base parameters.\n"
      "struct Sizes {{\n"
      "  static constexpr int nq = {2}_NQ, nchi = {2}_NCHI, nbeta = {2}_NBETA;\n"
      "}};\n"
      "inline constexpr int NQ = Sizes::nq, NCHI = Sizes::nchi, NBETA = Sizes::nbeta;\n\n"
      "using Scalar = {3};\n"
      "/// Row-major, as the arrays of the C functions are.\n"
      "template <int rows, int columns = 1>\n"
      "using Matrix = Eigen::Matrix<Scalar, rows, columns,\n"
      "                             columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;\n"
      "using Vector = Matrix<NQ>;  ///< one value per joint: q, dq, ddq, tau\n"
      "using Chi = Matrix<NCHI>;   ///< in the order of enum {1}_chi\n"
      "using Isometry = Eigen::Transform<Scalar, 3, Eigen::Isometry>;\n",
      options.header_name, options.prefix, upper,
      options.scalar == Scalar::kDouble ? "double" : "float");
  return text;
}

/// The types of batches, of large matrices and of folded parameters, where functions have them.
std::string types_text(const CodeModel& code, const std::vector<RobotFunction>& functions,
                       const EmitOptions& options, bool batch) {
  std::string text;
  const auto is_large = [&](const OutputSpec& output) {
    return output_type(output, code, options.scalar).on_heap;
  };
  if (batch) {
    text +=
        "/// One row for each sample: each column is contiguous, as the batch functions want it.\n"
        "template <int columns>\n"
        "using Batch = Eigen::Matrix<Scalar, Eigen::Dynamic, columns>;\n"
        "/// @throws std::invalid_argument  if an argument has another number of samples\n"
        "inline void check_samples(const char* argument, Eigen::Index rows, Eigen::Index samples) "
        "{\n"
        "  if (rows == samples) return;\n"
        "  throw std::invalid_argument(std::string(argument) + \" has \" + std::to_string(rows) +\n"
        "                              \" samples, expected \" + std::to_string(samples));\n"
        "}\n";
  }
  const bool large = std::any_of(functions.begin(), functions.end(), [&](const auto& function) {
    const auto& outputs = function.spec->outputs;
    return std::any_of(outputs.begin(), outputs.end(), is_large);
  });
  if (large) {
    text +=
        "/// What Eigen does not take on the stack.\n"
        "using LargeMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, "
        "Eigen::RowMajor>;\n";
  }
  if (code.folds()) {
    text += fmt::format(
        "/// What fold() makes of chi for the other functions, in the order of enum {0}_folded.\n"
        "inline constexpr int NFOLDED = {1}_NFOLDED;\nusing Folded = Matrix<NFOLDED>;\n",
        options.prefix, upper_case(options.prefix));
  }
  return text;
}

std::string names_text(const CodeModel& code) {
  std::vector<std::string> chi_names;
  for (const ChiEntry& entry : code.chi) chi_names.push_back(entry.name);
  std::string text = view_table("joint_names", code.coordinate_names);
  text += view_table("chi_names", chi_names);
  text += view_table("beta_names", code.beta) + "\n";
  return text;
}

/// The numbers of the robot file, and a new state.
std::string values_text(const CodeModel& code, const std::vector<RobotFunction>& functions,
                        const EmitOptions& options) {
  std::string text;
  if (code.takes_chi || !code.chi.empty()) {
    text += fmt::format(
        "/// The numbers of the robot file; NaN where the file says '*'.\n"
        "[[nodiscard]] inline Chi chi_values() noexcept {{\n"
        "  return Eigen::Map<const Chi>(::{}_chi_values);\n}}\n\n",
        options.prefix);
  }
  if (any_has_state(code, functions)) {
    text += fmt::format(
        "/// What effects remember between two calls; of the functions that take it, one is called "
        "in each\n/// period. @param dt  the time between two calls, s\n"
        "using State = ::{0}_state;\n"
        "[[nodiscard]] inline State new_state(Scalar dt) noexcept {{\n"
        "  State s;\n  ::{0}_reset(&s, dt);\n  return s;\n}}\n\n",
        options.prefix);
  }
  return text;
}

}  // namespace

std::string emit_cpp(const CodeModel& code, const std::vector<RobotFunction>& functions,
                     const EmitOptions& options) {
  check_namespace(code, options.prefix);
  const bool batch = std::any_of(functions.begin(), functions.end(),
                                 [](const RobotFunction& function) { return function.batch; });
  std::string text = preamble(code, options, batch) + types_text(code, functions, options, batch) +
                     "\n" + names_text(code) + values_text(code, functions, options);
  for (const RobotFunction& function : functions) {
    if (function.scalar) text += function_text(function, code, options);
    if (function.batch) text += batch_text(function, code, options);
  }
  return text + fmt::format("}}  // namespace {}\n\n#endif /* {}_HPP */\n", options.prefix,
                            upper_case(options.prefix));
}

}  // namespace dyngen
