// SPDX-License-Identifier: MIT
#include "runtime/import/guess/column_words.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace dyngen::runtime {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_letter(char c) { return is_upper(c) || (c >= 'a' && c <= 'z'); }

struct RoleWord {
  std::string_view word;
  ColumnRole role;
};

// Words of English and German logs, and of the usual drivers. Short ones last: they say least.
constexpr std::array<RoleWord, 61> kRoleWords = {{{"timestamp", ColumnRole::kTime},
                                                  {"stamp", ColumnRole::kTime},
                                                  {"time", ColumnRole::kTime},
                                                  {"zeit", ColumnRole::kTime},
                                                  {"temperature", ColumnRole::kTemperature},
                                                  {"temp", ColumnRole::kTemperature},
                                                  {"temperatur", ColumnRole::kTemperature},
                                                  {"voltage", ColumnRole::kVoltage},
                                                  {"volts", ColumnRole::kVoltage},
                                                  {"volt", ColumnRole::kVoltage},
                                                  {"spannung", ColumnRole::kVoltage},
                                                  {"pwm", ColumnRole::kDuty},
                                                  {"duty", ColumnRole::kDuty},
                                                  {"current", ColumnRole::kCurrent},
                                                  {"currents", ColumnRole::kCurrent},
                                                  {"cur", ColumnRole::kCurrent},
                                                  {"curr", ColumnRole::kCurrent},
                                                  {"amps", ColumnRole::kCurrent},
                                                  {"strom", ColumnRole::kCurrent},
                                                  {"iq", ColumnRole::kCurrent},
                                                  {"acceleration", ColumnRole::kAcceleration},
                                                  {"accelerations", ColumnRole::kAcceleration},
                                                  {"accel", ColumnRole::kAcceleration},
                                                  {"acc", ColumnRole::kAcceleration},
                                                  {"qdd", ColumnRole::kAcceleration},
                                                  {"ddq", ColumnRole::kAcceleration},
                                                  {"velocity", ColumnRole::kVelocity},
                                                  {"velocities", ColumnRole::kVelocity},
                                                  {"vel", ColumnRole::kVelocity},
                                                  {"speed", ColumnRole::kVelocity},
                                                  {"omega", ColumnRole::kVelocity},
                                                  {"geschwindigkeit", ColumnRole::kVelocity},
                                                  {"qd", ColumnRole::kVelocity},
                                                  {"dq", ColumnRole::kVelocity},
                                                  {"qp", ColumnRole::kVelocity},
                                                  {"torque", ColumnRole::kTorque},
                                                  {"torques", ColumnRole::kTorque},
                                                  {"effort", ColumnRole::kTorque},
                                                  {"efforts", ColumnRole::kTorque},
                                                  {"eff", ColumnRole::kTorque},
                                                  {"tau", ColumnRole::kTorque},
                                                  {"trq", ColumnRole::kTorque},
                                                  {"moment", ColumnRole::kTorque},
                                                  {"drehmoment", ColumnRole::kTorque},
                                                  {"mom", ColumnRole::kTorque},
                                                  {"force", ColumnRole::kTorque},
                                                  {"m", ColumnRole::kTorque},
                                                  {"position", ColumnRole::kPosition},
                                                  {"positions", ColumnRole::kPosition},
                                                  {"pos", ColumnRole::kPosition},
                                                  {"angle", ColumnRole::kPosition},
                                                  {"winkel", ColumnRole::kPosition},
                                                  {"theta", ColumnRole::kPosition},
                                                  {"encoder", ColumnRole::kPosition},
                                                  {"enc", ColumnRole::kPosition},
                                                  {"q", ColumnRole::kPosition},
                                                  {"a", ColumnRole::kPosition},
                                                  {"enable", ColumnRole::kFlag},
                                                  {"enabled", ColumnRole::kFlag},
                                                  {"t", ColumnRole::kTime},
                                                  {"ts", ColumnRole::kTime}}};

constexpr std::array<std::string_view, 25> kCommanded = {
    {"cmd",   "command",   "commanded", "target",   "desired", "des",   "goal",
     "ref",   "reference", "soll",      "setpoint", "sp",      "cmptd", "computed",
     "error", "err",       "model",     "sim",      "planned", "plan",  "wanted",
     "set",   "ideal",     "estimate",  "estimated"}};

/// Where the numbers of a name stand: begin and length.
std::vector<std::pair<std::size_t, std::size_t>> numbers_in(const std::string& name) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t k = 0; k < name.size();) {
    if (!is_digit(name[k])) {
      ++k;
      continue;
    }
    std::size_t end = k;
    while (end < name.size() && is_digit(name[end])) ++end;
    if (end - k <= 3) all.emplace_back(k, end - k);
    k = end;
  }
  return all;
}

/// Columns of one pattern by the number in its place.
using Numbered = std::map<std::string, std::map<int, std::size_t>>;

void add_named(const std::vector<std::string>& columns, const std::vector<std::string>& joints,
               std::vector<bool>& used, std::vector<ColumnFamily>& families) {
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> named;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::size_t at = columns[c].find(joints[j]);
      if (at == columns[c].npos) continue;
      std::string pattern = columns[c];
      pattern.replace(at, joints[j].size(), "{joint}");
      named[pattern].emplace_back(j, c);
    }
  }
  for (auto& [pattern, members] : named) {
    if (members.size() != joints.size()) continue;
    std::sort(members.begin(), members.end());
    ColumnFamily family{pattern, {}, {}};
    bool each_once = true;
    for (std::size_t j = 0; j < members.size(); ++j) {
      each_once = each_once && members[j].first == j && !used[members[j].second];
      family.columns.push_back(members[j].second);
    }
    if (!each_once) continue;
    for (const std::size_t c : family.columns) used[c] = true;
    families.push_back(std::move(family));
  }
}

}  // namespace

std::vector<std::string> bracketed_names(const std::vector<std::string>& columns) {
  std::map<std::string, std::vector<std::string>> by_prefix;
  std::vector<std::string> order;
  for (const std::string& column : columns) {
    const std::size_t open = column.find('[');
    if (open == column.npos || open == 0 || column.back() != ']') continue;
    const std::string name = column.substr(open + 1, column.size() - open - 2);
    if (name.empty() || std::all_of(name.begin(), name.end(), is_digit)) continue;
    const std::string prefix = column.substr(0, open);
    if (by_prefix[prefix].empty()) order.push_back(prefix);
    by_prefix[prefix].push_back(name);
  }
  for (const std::string& prefix : order) {
    if (role_of_words(words_of(prefix)) == ColumnRole::kPosition) return by_prefix[prefix];
  }
  return {};
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) words.push_back(std::move(word));
    word.clear();
  };
  for (std::size_t k = 0; k < name.size(); ++k) {
    const char c = name[k];
    const bool number = is_digit(c);
    if (!is_letter(c) && !number) {
      end_word();
      continue;
    }
    const bool was_number = !word.empty() && is_digit(word.back());
    const bool camel = is_upper(c) && k > 0 && is_letter(name[k - 1]) && !is_upper(name[k - 1]);
    if (!word.empty() && (was_number != number || camel)) end_word();
    word += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  end_word();
  return words;
}

std::optional<ColumnRole> role_of_words(const std::vector<std::string>& words) {
  const auto has = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  // "torque_enable" is a flag, whatever it enables
  if (has("enable") || has("enabled")) return ColumnRole::kFlag;
  for (const RoleWord& known : kRoleWords) {
    if (!has(known.word)) continue;
    // "TorqueCur": torque that was made of currents
    const bool made = known.role == ColumnRole::kCurrent && (has("torque") || has("tau"));
    return made ? ColumnRole::kTorque : known.role;
  }
  return std::nullopt;
}

std::string commanded_word(const std::vector<std::string>& words) {
  for (const std::string_view known : kCommanded) {
    if (std::find(words.begin(), words.end(), known) != words.end()) return std::string(known);
  }
  return {};
}

std::vector<ColumnFamily> column_families(const std::vector<std::string>& columns,
                                          const std::vector<std::string>& joints) {
  std::vector<ColumnFamily> families;
  std::vector<bool> used(columns.size(), false);
  if (!joints.empty()) add_named(columns, joints, used, families);
  Numbered numbered;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (used[c]) continue;
    for (const auto& [at, length] : numbers_in(columns[c])) {
      std::string pattern = columns[c];
      const int number = std::stoi(pattern.substr(at, length));
      if (std::to_string(number).size() != length) continue;  // "01" is no pattern
      pattern.replace(at, length, "{n}");
      numbered[pattern].emplace(number, c);
    }
  }
  // the largest first: each column belongs to one
  std::vector<std::pair<std::string, std::map<int, std::size_t>>> sorted(numbered.begin(),
                                                                         numbered.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  for (auto& [pattern, members] : sorted) {
    const int first = members.begin()->first;
    const bool whole = members.rbegin()->first - first + 1 == static_cast<int>(members.size());
    const bool free = std::none_of(members.begin(), members.end(),
                                   [&](const auto& member) { return used[member.second]; });
    if (!whole || !free || first > 1 || (members.size() == 1 && first == 0)) continue;
    ColumnFamily family{pattern, {}, {}};
    if (first == 0) family.pattern.replace(family.pattern.find("{n}"), 3, "{i}");
    for (const auto& [number, c] : members) {
      family.columns.push_back(c);
      used[c] = true;
    }
    families.push_back(std::move(family));
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!used[c]) families.push_back({columns[c], {c}, {}});
  }
  for (ColumnFamily& family : families) {
    std::string bare = family.pattern;
    for (const char* mark : {"{n}", "{i}", "{joint}"}) {
      const std::size_t at = bare.find(mark);
      if (at != bare.npos) bare.replace(at, std::string(mark).size(), " ");
    }
    family.words = words_of(bare);
  }
  std::stable_sort(families.begin(), families.end(),
                   [](const ColumnFamily& a, const ColumnFamily& b) {
                     return a.columns.front() < b.columns.front();
                   });
  return families;
}

}  // namespace dyngen::runtime
