// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/generator/generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "gen/emit_cpp/emit_cpp.h"

namespace dyngen {
namespace {

bool is_c_identifier(const std::string& text) {
  const auto word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), word);
}

/// Base parameters must then do for gravity in any direction.
RobotModel with_unknown_gravity(RobotModel model) {
  for (Quantity& component : model.gravity) component.unknown = true;
  return model;
}

/// "id" of "id_batch".
std::string_view without_batch(std::string_view name) {
  if (name.ends_with(kBatchEnding)) name.remove_suffix(kBatchEnding.size());
  return name;
}

/// Only one function reads weights, and only if it is asked for by its name.
bool asks_for_weights(const GeneratorOptions& options) {
  return std::any_of(options.functions.begin(), options.functions.end(), [](const auto& text) {
    const FunctionSpec* spec = find_function(without_batch(text));
    return spec != nullptr && spec->reads.weights;
  });
}

/// A function, in which forms it is asked for.
struct WantedFunction {
  FunctionName name;
  bool scalar = false;
  bool batch = false;
};

/// In the catalogue's order; of one of them: the last link's, then links as they are numbered.
std::vector<WantedFunction> wanted_functions(const GeneratorOptions& options) {
  std::vector<WantedFunction> wanted;
  for (const FunctionSpec& spec : function_catalogue()) {
    std::map<int, WantedFunction> links;
    if (options.functions.empty()) links[0].scalar = true;
    for (const std::string& text : options.functions) {
      if (text == kAllFunctions) {
        links[0].scalar = links[0].batch = true;
        continue;
      }
      const std::string_view base = without_batch(text);
      const FunctionName name = parse_function_name(base);
      if (name.spec != &spec) continue;
      (base == text ? links[name.link].scalar : links[name.link].batch) = true;
    }
    for (auto& [link, function] : links) {
      function.name = {&spec, link};
      wanted.push_back(function);
    }
  }
  return wanted;
}

/// True if the robot has no such function, and all were asked for.
/// @throws ModelError  if it was asked for by its name
bool is_absent(const FunctionName& name, const CodeModel& code, const GeneratorOptions& options) {
  if (name.spec->why_absent == nullptr) return false;
  const std::string reason = name.spec->why_absent(code);
  if (reason.empty()) return false;
  for (const std::string& text : options.functions) {
    if (parse_function_name(without_batch(text)).spec != name.spec) continue;
    throw ModelError(
        fmt::format("{}: error: --functions: '{}': {}\n", code.file_name, text, reason));
  }
  if (name.spec->is_missed && options.left_out) options.left_out(name.text(), reason);
  return true;
}

constexpr const char* kNoBatch =
    "effects of this robot remember the call before, and the samples of a batch have no order";

/// A batch has no order of samples: what remembers the call before has none.
/// @throws ModelError  if it was asked for by its name
void check_batch(const WantedFunction& wanted, const CodeModel& code,
                 const GeneratorOptions& options) {
  if (!wanted.batch || !has_state(*wanted.name.spec, code)) return;
  for (const std::string& text : options.functions) {
    if (text == kAllFunctions || without_batch(text) == text ||
        parse_function_name(without_batch(text)).spec != wanted.name.spec) {
      continue;
    }
    throw ModelError(
        fmt::format("{}: error: --functions: '{}': {}\n", code.file_name, text, kNoBatch));
  }
  if (options.left_out) options.left_out(wanted.name.text() + std::string(kBatchEnding), kNoBatch);
}

}  // namespace

void GeneratorOptions::validate() const {
  for (const std::string& name : functions) {
    if (name != kAllFunctions && find_function(without_batch(name)) == nullptr) {
      throw std::invalid_argument(
          fmt::format("--functions: unknown function '{}'; expected {}, one of them with {}, or {}",
                      name, catalogue_names(), kBatchEnding, kAllFunctions));
    }
  }
  if (fold && parameters != ParameterMode::kRuntime) {
    throw std::invalid_argument(
        "--fold: the file's numbers stand in the code already; expected --parameters runtime");
  }
  if (search.work < 0) {
    throw std::invalid_argument(
        fmt::format("--search: {} is negative; expected 0 or more", search.work));
  }
  if (!prefix.empty() && !is_c_identifier(prefix)) {
    throw std::invalid_argument(fmt::format(
        "--prefix: '{}' is not a C identifier; expected letters, digits and '_', no digit first",
        prefix));
  }
}

void GeneratorOptions::validate(const RobotModel& model) const {
  validate();
  if (wrench && wrench_link > model.size()) {
    throw std::invalid_argument(fmt::format("--wrench: {} has no link {}; expected 1 to {}",
                                            model.name, wrench_link, model.size()));
  }
  for (const std::string& text : functions) {
    const FunctionName name = parse_function_name(without_batch(text));
    if (name.link <= model.size()) continue;
    throw std::invalid_argument(
        fmt::format("--functions: '{}': {} has no link {}; expected {}_1 to {}_{}", text,
                    model.name, name.link, name.spec->name, name.spec->name, model.size()));
  }
}

SymbolicRobot make_symbolic(const RobotModel& model, const GeneratorOptions& options) {
  return make_symbolic(options.gravity ? with_unknown_gravity(model) : model);
}

std::vector<BoundEffect> bound_effects(const RobotModel& model, const GeneratorOptions& options) {
  if (!options.effects || model.effects.empty()) return {};
  return bind_effects(model, options.catalogue ? *options.catalogue : EffectCatalogue());
}

CodeModel make_code_model(const RobotModel& model, const GeneratorOptions& options) {
  const SymbolicRobot robot = make_symbolic(model, options);
  const Regrouping base = regroup(robot);
  CodeModel code = make_code_model(options.regroup ? base : keep_standard(robot), base.parameters,
                                   {.parameters = options.parameters,
                                    .gravity = options.gravity,
                                    .wrench = options.wrench,
                                    .wrench_link = options.wrench_link,
                                    .payload = options.payload,
                                    .weights = asks_for_weights(options),
                                    .fold = options.fold},
                                   bound_effects(model, options));
  add_bodies(code, robot, options.regroup, model.parameters);
  return code;
}

std::vector<RobotFunction> write_functions(CodeModel& code, const GeneratorOptions& options) {
  std::vector<WantedFunction> all = wanted_functions(options);
  std::erase_if(all, [&](const auto& wanted) { return is_absent(wanted.name, code, options); });
  std::vector<FunctionName> names;
  for (WantedFunction& wanted : all) {
    check_batch(wanted, code, options);
    wanted.batch = wanted.batch && !has_state(*wanted.name.spec, code);
    names.push_back(wanted.name);
  }
  std::vector<RobotFunction> functions =
      write_functions(names, code, options.search, options.progress);
  for (std::size_t i = 0; i < all.size(); ++i) {
    functions[i].scalar = all[i].scalar;
    functions[i].batch = all[i].batch;
  }
  return functions;
}

CText generate(const RobotModel& model, const GeneratorOptions& options) {
  options.validate(model);
  CodeModel code = make_code_model(model, options);
  const std::vector<RobotFunction> functions = write_functions(code, options);
  return generated_text(model, code, functions, options);
}

CText generated_text(const RobotModel& model, const CodeModel& code,
                     const std::vector<RobotFunction>& functions, const GeneratorOptions& options) {
  EmitOptions emit;
  emit.prefix = options.prefix.empty() ? model.name : options.prefix;
  emit.scalar = options.scalar;
  emit.trig = options.trig;
  emit.header_name = options.header_name.empty() ? emit.prefix + ".h" : options.header_name;
  CText text = emit_c(code, functions, emit);
  if (options.cpp_wrapper) text.wrapper = emit_cpp(code, functions, emit);
  return text;
}

std::string count_table(const CodeModel& code, const std::vector<RobotFunction>& functions) {
  std::string text = fmt::format("{}: {} joints, {} base parameters\n", code.name,
                                 code.coordinate_names.size(), code.beta.size());
  const bool calls = std::any_of(functions.begin(), functions.end(), [](const auto& function) {
    return function.trace.count().calls > 0;
  });
  text += fmt::format("{:<24}{:>6}{:>6}{:>8}{:>9}{:>6}{:>6}{}\n", "function", "mul", "add",
                      "mul+add", "sin/cos", "sgn", "div", calls ? " calls" : "");
  for (const RobotFunction& function : functions) {
    const OperationCount count = function.trace.count();
    text +=
        fmt::format("{:<24}{:>6}{:>6}{:>8}{:>9}{:>6}{:>6}{}\n", function.name,
                    count.multiplications, count.additions, count.total(), count.sin_cos_pairs,
                    count.signs, count.divisions, calls ? fmt::format("{:>6}", count.calls) : "");
  }
  const int n = static_cast<int>(code.coordinate_names.size());
  const int mul = 105 * n - 92, add = 94 * n - 86;
  text += fmt::format("{:<24}{:>6}{:>6}{:>8}   (105n - 92, 94n - 86, n = {})\n", "bound", mul, add,
                      mul + add, n);
  return text;
}

}  // namespace dyngen
