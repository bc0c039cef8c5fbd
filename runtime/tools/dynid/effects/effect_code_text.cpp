// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_code_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/generator/generator.h"

namespace dyngen::runtime {
namespace {

/// Statements of a function, their lines joined, from its opening brace to its last one.
std::vector<std::string> statements_of(const std::string& source, const std::string& function) {
  const std::size_t begin = source.find("void " + function + "(");
  if (begin == std::string::npos) return {};
  std::istringstream lines(source.substr(source.find("{\n", begin) + 2));
  std::vector<std::string> statements;
  bool open = false;
  for (std::string line; std::getline(lines, line) && line != "}";) {
    if (open) {
      statements.back() += "\n" + line;
    } else {
      statements.push_back(line);
    }
    const std::size_t comment = line.find("/*");
    const std::string code = line.substr(0, comment);
    const bool only_comment = code.find_first_not_of(' ') == std::string::npos;
    open = !only_comment && code.find(';') == std::string::npos && line.back() != '{' &&
           line.back() != '}';
  }
  return statements;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Whether a name stands in a text, alone or as the beginning of a longer one.
bool names(const std::string& text, const std::string& name, bool beginning) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const bool begins = at == 0 || !is_word(text[at - 1]);
    const std::size_t end = at + name.size();
    const bool ends = end == text.size() || !is_word(text[end]);
    if ((begins || text[at - 1] == 'm') && (ends || (beginning && text[end] == '_'))) return true;
  }
  return false;
}

/// "x" of "  const double x = ..."; empty of other statements.
std::string defined(const std::string& statement) {
  const std::string start = "const double ";
  const std::size_t at = statement.find(start);
  if (at == std::string::npos || statement.find_first_not_of(' ') != at) return {};
  const std::size_t from = at + start.size();
  return statement.substr(from, statement.find_first_of(" [=", from) - from);
}

}  // namespace

std::string why_no_code(const EffectInstance& effect, const EffectCatalogue& catalogue) {
  const std::shared_ptr<const EffectFile> file = catalogue.find(effect.law.name);
  return file == nullptr ? "it is in no effect file" : why_not_in_controller(*file);
}

std::string effect_code_text(const RobotFile& file, std::size_t row, const EffectInstance& effect,
                             const std::shared_ptr<const EffectCatalogue>& catalogue) {
  if (!why_no_code(effect, *catalogue).empty()) return {};
  GeneratorOptions options;
  options.functions = {"friction"};
  options.prefix = "arm";
  options.header_name = "arm.h";
  options.catalogue = catalogue;
  std::string source;
  try {
    RobotModel model = build_model(file);
    if (row >= model.effects.size()) return {};
    model.effects = {model.effects[row]};
    source = generate(model, options).source;
  } catch (const ModelError&) {
    return {};  // parameters that are no numbers
  }
  std::string name = effect.law.name;
  if (effect.link > 0) name += fmt::format("_{}", effect.link);
  const std::vector<std::string> statements = statements_of(source, "arm_friction");
  std::vector<bool> kept(statements.size(), false);
  for (std::size_t i = 0; i < statements.size(); ++i) kept[i] = names(statements[i], name, true);
  // what reads a result of the effect, down to the torque
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const std::string result = defined(statements[i]);
    if (!kept[i] || result.empty() || statements[i].find("/*") != std::string::npos) continue;
    for (std::size_t k = i + 1; k < statements.size(); ++k) {
      kept[k] = kept[k] || names(statements[k], result, false);
    }
  }
  std::string text;
  for (std::size_t i = 0; i < statements.size(); ++i) {
    if (kept[i])
      text += statements[i].substr(std::min<std::size_t>(2, statements[i].size())) + "\n";
  }
  return text;
}

}  // namespace dyngen::runtime
