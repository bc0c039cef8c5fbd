// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/keywords.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "gen/words/spelling.h"

namespace dyngen {

namespace {

constexpr std::array<std::string_view, kRowKeyCount> kRowSpellings = {
    "sigma", "al",   "d",    "th",   "r",      "ant", "XX",  "XY",  "XZ",  "YY",
    "YZ",    "ZZ",   "mX",   "mY",   "mZ",     "m",   "IA",  "Fs",  "Fv",  "off",
    "qmin",  "qmax", "vmax", "amax", "taumax", "gx",  "gy",  "gz",  "cX",  "cY",
    "cZ",    "IXX",  "IXY",  "IXZ",  "IYY",    "IYZ", "IZZ", "irX", "irY", "irZ"};

constexpr std::array<Keyword, 9> kOtherKeywords = {{
    {"name", Statement::kName},
    {"number_link", Statement::kNumberLink},
    {"number'link", Statement::kNumberLink},  // the spelling of Appendix B
    {"dh", Statement::kDh},
    {"parameters", Statement::kParameters},
    {"let", Statement::kLet},
    {"joints", Statement::kJoints},
    {"effect", Statement::kEffect},
    {"stop", Statement::kStop},
}};

/// Words of other robot formats, and what they are called here.
struct Synonym {
  std::string_view word;  // lower case
  std::string_view hint;
};

constexpr std::array<Synonym, 14> kSynonyms = {{
    {"a", "the DH length a is 'd' here"},
    {"alpha", "the DH angle alpha is 'al' here"},
    {"theta", "the DH angle theta is 'th' here"},
    {"offset", "an offset of a joint angle stands in 'th', of a torque in 'off'"},
    {"parent", "the parent link of each joint stands in 'ant'"},
    {"mass", "masses stand in 'm'"},
    {"com", "the centre of mass stands in cX cY cZ"},
    {"g", "gravity stands in gx, gy, gz"},
    {"gravity", "gravity stands in gx, gy, gz"},
    {"end", "the last row is 'stop'"},
    {"n", "the number of joints stands in 'number_link'"},
    {"fc", "Coulomb friction stands in 'Fs', viscous in 'Fv'"},
    {"jm", "the rotor inertia stands in 'IA'"},
    {"//", "a comment begins with '#' or ';'"},
}};

std::map<std::string, Keyword, std::less<>> make_keywords() {
  std::map<std::string, Keyword, std::less<>> keywords;
  for (const Keyword& keyword : kOtherKeywords) {
    keywords.emplace(lower_case(keyword.spelling), keyword);
  }
  for (std::size_t i = 0; i < kRowKeyCount; ++i) {
    const Keyword keyword{kRowSpellings[i], Statement::kValues, static_cast<RowKey>(i)};
    keywords.emplace(lower_case(keyword.spelling), keyword);
  }
  return keywords;
}

std::vector<std::string_view> all_spellings() {
  std::vector<std::string_view> spellings(kRowSpellings.begin(), kRowSpellings.end());
  for (const Keyword& keyword : kOtherKeywords) spellings.push_back(keyword.spelling);
  return spellings;
}

}  // namespace

std::string_view row_keyword(RowKey key) { return kRowSpellings[static_cast<std::size_t>(key)]; }

const Keyword* find_keyword(std::string_view word) {
  constexpr std::size_t kLongest = 11;  // spares a copy of a line-long value
  static const auto keywords = make_keywords();
  if (word.size() > kLongest) return nullptr;
  const auto found = keywords.find(lower_case(word));
  return found == keywords.end() ? nullptr : &found->second;
}

std::string keyword_hint(std::string_view word) {
  if (word.starts_with("//")) word = word.substr(0, 2);
  const std::string lower = lower_case(word);
  for (const Synonym& synonym : kSynonyms) {
    if (synonym.word == lower) return std::string(synonym.hint);
  }
  const std::string_view nearest = nearest_word(word, all_spellings());
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  return "a row begins with a keyword: sigma, al, d, th, r, m, mX, ..., gz, stop";
}

bool may_be_unknown(RowKey key) {
  switch (key) {
    case RowKey::kSigma:
    case RowKey::kAl:
    case RowKey::kTh:
    case RowKey::kAnt:
    case RowKey::kIrX:
    case RowKey::kIrY:
    case RowKey::kIrZ:
      return false;
    default:
      return !is_limit(key);
  }
}

bool is_limit(RowKey key) {
  switch (key) {
    case RowKey::kQmin:
    case RowKey::kQmax:
    case RowKey::kVmax:
    case RowKey::kAmax:
    case RowKey::kTaumax:
      return true;
    default:
      return false;
  }
}

bool is_cad_row(RowKey key) { return key >= RowKey::kCX && key <= RowKey::kIrZ; }

bool has_other_form(RowKey key) {
  return is_cad_row(key) || (key >= RowKey::kXX && key <= RowKey::kMZ);
}

bool is_scalar(RowKey key) {
  return key == RowKey::kGx || key == RowKey::kGy || key == RowKey::kGz;
}

}  // namespace dyngen
