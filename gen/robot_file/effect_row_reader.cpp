// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/effect_row_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "gen/robot_file/name_rows.h"
#include "gen/robot_file/value_reader.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

/// A part of a word that has no bad characters, and so is ASCII.
Word part_of(const Word& word, std::size_t offset, std::size_t count) {
  Word part = word;
  part.text = word.text.substr(offset, count);
  part.position.column += static_cast<int>(offset);
  part.length = static_cast<int>(part.text.size());
  return part;
}

/// Whether the word after the next is a '=' that should not stand alone.
bool before_equals(const RowWords& words) {
  const Word* after = words.after_next();
  return after != nullptr && after->text.front() == '=';
}

/// `key=value`; absent if it has another form, which is reported.
std::optional<EffectRow::Setting> read_setting(RowWords& words, const Word& word) {
  if (word.is_bad()) {
    report_bad_character(word, words.diagnostics());
    return std::nullopt;
  }
  const std::size_t equals = word.text.find('=');
  const bool complete = equals != word.text.npos && equals + 1 < word.text.size();
  if (!complete || !is_identifier(word.text.substr(0, equals))) {
    words.error(word,
                fmt::format("expected a setting of the effect, found '{}'", printable(word.text)),
                "a setting is NAME=VALUE without blanks: vs=0.05");
    return std::nullopt;
  }
  ValueList list;
  const Word key = part_of(word, 0, equals);
  read_value(words, part_of(word, equals + 1, word.text.npos), printable(key.text), true, list);
  return EffectRow::Setting{std::string(key.text), key.position, std::move(list.values.front())};
}

}  // namespace

std::optional<EffectRow> read_effect_row(RowWords& words, const Word& keyword) {
  const Word* name = read_one_name(words, keyword, "effect");
  if (name == nullptr) {
    words.skip_line();
    return std::nullopt;
  }
  EffectRow effect{std::string(name->text), name->position, {}};
  std::set<std::string_view> keys;
  while (!words.at_line_end() && (!words.at_keyword() || before_equals(words))) {
    const Word& word = words.take();
    if (std::optional<EffectRow::Setting> setting = read_setting(words, word)) {
      const std::string_view key = word.text.substr(0, setting->key.size());
      if (!keys.insert(key).second) {
        words.error(word, fmt::format("setting '{}' stands twice", printable(key)),
                    "an effect has each setting once");
      }
      effect.settings.push_back(std::move(*setting));
    } else {
      words.skip_line();
    }
  }
  return effect;
}

}  // namespace dyngen
