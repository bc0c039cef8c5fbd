// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "gen/diagnostic/utf8.h"
#include "gen/effect_file/effect_rows.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

/// Reads the rows one by one into an EffectFile.
class Reader {
 public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  EffectFile run(const std::string& text) {
    for (const EffectRowText& row : split_effect_rows(text, diagnostics_)) {
      if (diagnostics_.full()) break;
      read(row);
    }
    check_complete();
    return std::move(effect_);
  }

 private:
  using Handler = void (Reader::*)(const EffectRowText&, EffectRowCursor&);
  struct Keyword {
    std::string_view name;
    Handler handler;
    bool repeats = false;
  };

  static const std::vector<Keyword>& keywords() {
    static const std::vector<Keyword> kKeywords = {{"effect", &Reader::read_name},
                                                   {"family", &Reader::read_family},
                                                   {"title", &Reader::read_title},
                                                   {"kind", &Reader::read_kind},
                                                   {"scope", &Reader::read_scope},
                                                   {"joints", &Reader::read_joints},
                                                   {"parameter", &Reader::read_parameter, true},
                                                   {"state", &Reader::read_state, true},
                                                   {"let", &Reader::read_let, true},
                                                   {"torque", &Reader::read_torque},
                                                   {"torque_other", &Reader::read_torque_other},
                                                   {"align", &Reader::read_align},
                                                   {"midpoint", &Reader::read_midpoint},
                                                   {"dissipates", &Reader::read_dissipates},
                                                   {"require", &Reader::read_require, true},
                                                   {"falsifier", &Reader::read_falsifier, true},
                                                   {"usual", &Reader::read_usual, true},
                                                   {"test", &Reader::read_test, true},
                                                   {"alias", &Reader::read_alias, true},
                                                   {"contains", &Reader::read_contains, true},
                                                   {"hidden", &Reader::read_hidden},
                                                   {"separate", &Reader::read_separate},
                                                   {"source", &Reader::read_source},
                                                   {"plot", &Reader::read_plot}};
    return kKeywords;
  }

  void error(const EffectText& at, const std::string& message, const std::string& hint = {}) {
    diagnostics_.error(at.position, std::max(1, character_count(at.text)), message, hint);
  }
  void error(SourcePosition at, const std::string& message, const std::string& hint = {}) {
    diagnostics_.error(at, 1, message, hint);
  }

  void read(const EffectRowText& row) {
    const auto& all = keywords();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Keyword& keyword) {
      return keyword.name == row.keyword;
    });
    if (found == all.end()) return report_unknown(row);
    const auto [first, is_first] = first_.emplace(row.keyword, row.position.line);
    if (!is_first && !found->repeats) {
      return error(EffectText{row.keyword, row.position},
                   fmt::format("row '{}' stands twice", row.keyword),
                   fmt::format("the first is on line {}", first->second));
    }
    EffectRowCursor cursor(row);
    (this->*found->handler)(row, cursor);
  }

  void report_unknown(const EffectRowText& row) {
    std::vector<std::string_view> names;
    for (const Keyword& keyword : keywords()) names.push_back(keyword.name);
    const std::string_view near = nearest_word(row.keyword, names);
    error(EffectText{row.keyword, row.position},
          fmt::format("unknown keyword '{}'", printable(row.keyword)),
          near.empty() ? "known keywords: " + comma_list(names)
                       : fmt::format("did you mean '{}'?", near));
  }

  /// A word that must be there. @return empty if it is not, which is reported
  EffectText expect_word(EffectRowCursor& cursor, std::string_view row, std::string_view what) {
    const SourcePosition place = cursor.place();
    if (std::optional<EffectText> word = cursor.word()) return *word;
    error(place, fmt::format("expected {} in '{}'", what, row));
    return {"", place};
  }

  void expect_end(EffectRowCursor& cursor, std::string_view row) {
    if (cursor.at_end()) return;
    const SourcePosition place = cursor.place();
    const std::string text = joined_text(cursor.rest());
    diagnostics_.error(place, 1, fmt::format("'{}' after the end of '{}'", printable(text), row));
  }

  std::optional<std::string> identifier(EffectRowCursor& cursor, std::string_view row) {
    const EffectText word = expect_word(cursor, row, "a name");
    if (word.text.empty()) return std::nullopt;
    if (is_identifier(word.text)) return word.text;
    error(word, fmt::format("'{}' is no name", printable(word.text)),
          "a name has letters, digits and '_', no digit first");
    return std::nullopt;
  }

  /// One of several words. @return its place among them
  std::optional<std::size_t> choice(EffectRowCursor& cursor, std::string_view row,
                                    const std::vector<std::string_view>& words) {
    const EffectText word = expect_word(cursor, row, comma_list(words));
    if (word.text.empty()) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), word.text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    const std::string_view near = nearest_word(word.text, words);
    error(word, fmt::format("unknown word '{}' in '{}'", printable(word.text), row),
          near.empty() ? "expected " + comma_list(words) : fmt::format("did you mean '{}'?", near));
    return std::nullopt;
  }

  EffectExpression expression(const std::vector<EffectText>& pieces, std::string_view row,
                              SourcePosition place) {
    if (pieces.empty()) {
      error(place, fmt::format("expected an expression in '{}'", row));
      return {};
    }
    return parse_effect_expression(pieces, std::string(row), diagnostics_);
  }

  std::string text_of(EffectRowCursor& cursor, std::string_view row) {
    const SourcePosition place = cursor.place();
    std::string text = joined_text(cursor.rest());
    if (text.empty()) error(place, fmt::format("expected text in '{}'", row));
    return text;
  }
  std::string text_after_colon(EffectRowCursor& cursor, std::string_view row) {
    if (cursor.colon()) return text_of(cursor, row);
    error(cursor.place(), fmt::format("expected ':' and a text in '{}'", row));
    return {};
  }

  void read_name(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto name = identifier(cursor, row.keyword)) effect_.name = *name;
    expect_end(cursor, row.keyword);
  }
  void read_family(const EffectRowText& row, EffectRowCursor& cursor) {
    const auto& families = effect_families();
    if (auto place = choice(cursor, row.keyword, families)) effect_.family = families[*place];
    expect_end(cursor, row.keyword);
  }
  void read_kind(const EffectRowText& row, EffectRowCursor& cursor) {
    kind_position_ = row.position;
    if (auto place =
            choice(cursor, row.keyword, {"algebraic", "stateful", "tangent", "alignment"})) {
      effect_.kind = static_cast<EffectKind>(*place);
    }
    expect_end(cursor, row.keyword);
  }
  void read_scope(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto place = choice(cursor, row.keyword, {"joint", "pair", "robot"})) {
      effect_.scope = static_cast<EffectScope>(*place);
    }
    expect_end(cursor, row.keyword);
  }
  void read_joints(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto place = choice(cursor, row.keyword, {"any", "revolute"})) {
      effect_.revolute_only = *place == 1;
    }
    expect_end(cursor, row.keyword);
  }
  void read_dissipates(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto place = choice(cursor, row.keyword, {"no", "yes"})) effect_.dissipates = *place == 1;
    expect_end(cursor, row.keyword);
  }
  void read_title(const EffectRowText& row, EffectRowCursor& cursor) {
    effect_.title = text_of(cursor, row.keyword);
  }
  void read_hidden(const EffectRowText& row, EffectRowCursor& cursor) {
    effect_.hidden = text_of(cursor, row.keyword);
  }
  void read_separate(const EffectRowText& row, EffectRowCursor& cursor) {
    effect_.separates = text_of(cursor, row.keyword);
  }
  void read_source(const EffectRowText& row, EffectRowCursor& cursor) {
    effect_.source = text_of(cursor, row.keyword);
  }
  void read_plot(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto name = identifier(cursor, row.keyword)) effect_.plot = *name;
    expect_end(cursor, row.keyword);
  }

  void read_parameter(const EffectRowText& row, EffectRowCursor& cursor) {
    EffectParameter parameter;
    parameter.position = cursor.place();
    const std::optional<std::string> name = identifier(cursor, row.keyword);
    const std::optional<std::size_t> role =
        choice(cursor, row.keyword, {"linear", "shape", "scanned", "given"});
    if (!name || !role) return;
    parameter.name = *name;
    parameter.role = static_cast<ParameterRole>(*role);
    std::map<std::string, bool> seen;
    while (std::optional<EffectText> word = cursor.word()) read_attribute(*word, parameter, seen);
    parameter.meaning = text_after_colon(cursor, row.keyword);
    if (!seen.contains("unit")) {
      error(parameter.position, fmt::format("parameter '{}' has no unit", *name),
            "write unit=1 for a pure number");
    }
    if (!seen.contains("typical")) {
      error(parameter.position, fmt::format("parameter '{}' has no typical size", *name),
            "write typical=VALUE: what such machines have");
    }
    if (!seen.contains("start")) parameter.start = parameter.typical;
    effect_.parameters.push_back(std::move(parameter));
  }

  void read_attribute(const EffectText& word, EffectParameter& parameter,
                      std::map<std::string, bool>& seen) {
    const std::size_t equals = word.text.find('=');
    if (equals == word.text.npos || equals + 1 == word.text.size()) {
      return error(word, fmt::format("expected KEY=VALUE, found '{}'", printable(word.text)),
                   "keys are unit, min, max, start, typical, grid, scale");
    }
    const std::string key = word.text.substr(0, equals);
    if (!seen.emplace(key, true).second) {
      return error(word, fmt::format("'{}' stands twice", printable(key)));
    }
    const EffectText value{
        word.text.substr(equals + 1),
        {word.position.line, word.position.column + static_cast<int>(equals) + 1}};
    const auto parsed = [&] { return parse_effect_expression({value}, key, diagnostics_); };
    if (key == "unit") {
      parameter.unit = value.text;
    } else if (key == "min") {
      parameter.min = parsed();
    } else if (key == "max") {
      parameter.max = parsed();
    } else if (key == "start") {
      parameter.start = parsed();
    } else if (key == "typical") {
      parameter.typical = parsed();
    } else if (key == "scale") {
      parameter.logarithmic = value.text == "log";
      if (value.text != "log" && value.text != "linear") {
        error(value, fmt::format("unknown scale '{}'", printable(value.text)),
              "expected log or linear");
      }
    } else if (key == "grid") {
      read_grid(value, parameter);
    } else {
      error(word, fmt::format("unknown key '{}'", printable(key)),
            "keys are unit, min, max, start, typical, grid, scale");
    }
  }

  void read_grid(const EffectText& value, EffectParameter& parameter) {
    constexpr int kMost = 100000;
    const char* const end = value.text.data() + value.text.size();
    const auto [stop, problem] = std::from_chars(value.text.data(), end, parameter.grid);
    if (problem == std::errc() && stop == end && parameter.grid >= 2 && parameter.grid <= kMost) {
      return;
    }
    error(value, fmt::format("'{}' is no number of values", printable(value.text)),
          fmt::format("expected a whole number from 2 to {}", kMost));
  }

  void read_state(const EffectRowText& row, EffectRowCursor& cursor) {
    EffectState state;
    state.position = cursor.place();
    const std::optional<std::string> name = identifier(cursor, row.keyword);
    if (!name) return;
    state.name = *name;
    while (std::optional<EffectText> word = cursor.word()) {
      const std::size_t equals = word->text.find('=');
      const std::string key = word->text.substr(0, equals);
      if (equals == word->text.npos ||
          (key != "unit" && key != "min" && key != "max" && key != "start")) {
        error(*word, fmt::format("expected unit=, min=, max= or start=, found '{}'",
                                 printable(word->text)));
        continue;
      }
      const EffectText value{
          word->text.substr(equals + 1),
          {word->position.line, word->position.column + static_cast<int>(equals) + 1}};
      if (key == "unit") state.unit = value.text;
      if (key == "min") state.min = parse_effect_expression({value}, key, diagnostics_);
      if (key == "max") state.max = parse_effect_expression({value}, key, diagnostics_);
      if (key == "start") state.start = parse_effect_expression({value}, key, diagnostics_);
    }
    if (state.unit.empty()) {
      error(state.position, fmt::format("state '{}' has no unit", *name),
            "write unit=1 for a pure number");
    }
    if (!cursor.colon()) {
      return error(cursor.place(), "expected ':' and the rate of the state in 'state'");
    }
    const SourcePosition place = cursor.place();
    state.rate = expression(cursor.rest(), row.keyword, place);
    effect_.states.push_back(std::move(state));
  }

  void read_let(const EffectRowText& row, EffectRowCursor& cursor) {
    const std::optional<std::string> name = identifier(cursor, row.keyword);
    if (!name) return;
    const SourcePosition place = cursor.place();
    effect_.lets.emplace_back(*name, expression(cursor.rest(), row.keyword, place));
  }

  void read_torque(const EffectRowText& row, EffectRowCursor& cursor) {
    const SourcePosition place = cursor.place();
    torque_ = expression(cursor.rest(), row.keyword, place);
  }
  void read_torque_other(const EffectRowText& row, EffectRowCursor& cursor) {
    const SourcePosition place = cursor.place();
    torque_other_ = expression(cursor.rest(), row.keyword, place);
  }

  void read_align(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto place = choice(cursor, row.keyword, {"delay", "lag"})) {
      effect_.alignment = static_cast<AlignmentOperator>(*place);
    }
    if (auto name = identifier(cursor, row.keyword)) effect_.alignment_parameter = *name;
    expect_end(cursor, row.keyword);
  }

  void read_midpoint(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto name = identifier(cursor, row.keyword)) effect_.midpoint = *name;
    expect_end(cursor, row.keyword);
  }

  /// left <= right, or left >= right the other way round.
  std::optional<EffectCondition> condition(const EffectRowText& row, EffectRowCursor& cursor) {
    const SourcePosition place = cursor.place();
    std::vector<EffectText> left, right;
    bool turned = false, found = false;
    for (EffectText piece : cursor.until_colon()) {
      const std::size_t at = found ? piece.text.npos : piece.text.find_first_of("<>");
      if (at == piece.text.npos) {
        (found ? right : left).push_back(std::move(piece));
        continue;
      }
      found = true;
      turned = piece.text[at] == '>';
      if (at + 1 >= piece.text.size() || piece.text[at + 1] != '=') {
        error(EffectText{piece.text.substr(at, 1),
                         {piece.position.line, piece.position.column + static_cast<int>(at)}},
              "expected '<=' or '>='");
        return std::nullopt;
      }
      if (at > 0) left.push_back({piece.text.substr(0, at), piece.position});
      if (at + 2 < piece.text.size()) {
        right.push_back({piece.text.substr(at + 2),
                         {piece.position.line, piece.position.column + static_cast<int>(at) + 2}});
      }
    }
    if (!found) {
      error(place, fmt::format("expected LEFT <= RIGHT in '{}'", row.keyword));
      return std::nullopt;
    }
    EffectCondition result;
    result.position = place;
    result.left = expression(turned ? right : left, row.keyword, place);
    result.right = expression(turned ? left : right, row.keyword, place);
    result.text = text_after_colon(cursor, row.keyword);
    return result;
  }
  void read_require(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto found = condition(row, cursor)) effect_.requirements.push_back(std::move(*found));
  }
  void read_falsifier(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto found = condition(row, cursor)) effect_.falsifiers.push_back(std::move(*found));
  }
  void read_usual(const EffectRowText& row, EffectRowCursor& cursor) {
    if (auto found = condition(row, cursor)) effect_.usual.push_back(std::move(*found));
  }

  void read_test(const EffectRowText& row, EffectRowCursor& cursor) {
    std::vector<std::string_view> names;
    for (const auto& [name, meaning] : effect_tests()) names.push_back(name);
    const SourcePosition position = cursor.place();
    const auto place = choice(cursor, row.keyword, names);
    if (!place) return;
    const std::string text = cursor.colon() ? text_of(cursor, row.keyword) : std::string();
    expect_end(cursor, row.keyword);
    effect_.tests.push_back({std::string(names[*place]), text, position});
  }

  void read_alias(const EffectRowText& row, EffectRowCursor& cursor) {
    std::vector<std::string_view> names = effect_families();
    names.push_back("base");  // a parameter of the model without effects
    read_family_and_text(row, cursor, names, effect_.aliases);
  }

  void read_contains(const EffectRowText& row, EffectRowCursor& cursor) {
    read_family_and_text(row, cursor, effect_families(), effect_.contains);
  }

  void read_family_and_text(const EffectRowText& row, EffectRowCursor& cursor,
                            const std::vector<std::string_view>& names,
                            std::vector<RelatedFamily>& list) {
    const SourcePosition position = cursor.place();
    const auto place = choice(cursor, row.keyword, names);
    if (!place) return;
    list.push_back({std::string(names[*place]), text_after_colon(cursor, row.keyword), position});
  }

  void check_complete() {
    if (diagnostics_.has_errors()) return;
    for (const std::string_view needed :
         {"effect", "family", "title", "kind", "scope", "torque", "hidden", "separate", "plot"}) {
      if (first_.contains(std::string(needed))) continue;
      error(SourcePosition{1, 1}, fmt::format("there is no row '{}'", needed),
            "see docs/reference/effect_file.md");
    }
    effect_.torque.push_back(std::move(torque_));
    if (first_.contains("torque_other")) effect_.torque.push_back(std::move(torque_other_));
  }

  Diagnostics& diagnostics_;
  EffectFile effect_;
  EffectExpression torque_, torque_other_;
  SourcePosition kind_position_;
  std::map<std::string, int> first_;
};

}  // namespace

EffectFile read_effect_rows(const std::string& text, Diagnostics& diagnostics) {
  return Reader(diagnostics).run(text);
}

}  // namespace dyngen
