// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/rules_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/words/spelling.h"

namespace dyngen::runtime {
namespace {

struct RuleWord {
  std::string_view text;
  int column = 1;
};

/// Words of a line before a comment.
std::vector<RuleWord> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<RuleWord> words;
  constexpr std::string_view kBlank = " \t\r";
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

class RulesReader {
 public:
  explicit RulesReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const DecisionRule* rule : all_rules(rules_)) names_.push_back(rule->name);
  }

  void read_line(int line, const std::vector<RuleWord>& words) {
    if (words.empty()) return;
    const auto error = [&](const RuleWord& word, const std::string& message,
                           const std::string& hint) {
      diagnostics_.error({line, word.column}, static_cast<int>(word.text.size()), message, hint);
    };
    const RuleWord& name = words.front();
    if (std::find(names_.begin(), names_.end(), name.text) == names_.end()) {
      const std::string_view near = nearest_word(name.text, names_);
      error(name, fmt::format("unknown rule '{}'", printable(name.text)),
            near.empty() ? "'dynid diagnose --print-rules' lists them"
                         : fmt::format("did you mean '{}'?", near));
      return;
    }
    if (!set_.insert(name.text).second) {
      error(name, fmt::format("rule '{}' stands twice", name.text), "remove one of them");
      return;
    }
    double value = 0;
    const std::string_view text = words.size() == 2 ? words[1].text : std::string_view();
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value) ||
        value < 0) {
      error(words.back(), fmt::format("expected one number behind '{}', not negative", name.text),
            "for example: " + std::string(name.text) + " 2");
      return;
    }
    set_rule(rules_, name.text, value);
  }

  [[nodiscard]] const DecisionRules& rules() const { return rules_; }

 private:
  Diagnostics& diagnostics_;
  DecisionRules rules_;
  std::vector<std::string_view> names_;
  std::set<std::string_view> set_;
};

}  // namespace

DecisionRules read_rules(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw std::runtime_error(path + ": cannot read the rules");
  Diagnostics diagnostics(path, text);
  RulesReader reader(diagnostics);
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    reader.read_line(++line, words_of(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
  return reader.rules();
}

std::string rules_text(const DecisionRules& rules) {
  std::string text;
  for (const DecisionRule* rule : all_rules(rules)) {
    text += fmt::format("# {} [{}; {}]\n{:<32} {:g}\n", rule->meaning, rule->unit, rule->source,
                        rule->name, rule->value);
  }
  return text;
}

}  // namespace dyngen::runtime
