// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symoro/par_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "gen/bodies/converted_robot.h"
#include "gen/robot_file/expression.h"
#include "gen/symoro/par_text.h"
#include "gen/words/characters.h"
#include "gen/words/spelling.h"

namespace dyngen {

namespace {

constexpr std::string_view kLettersOfBlanks = " \t\r\n";

/// Rows of a robot file by SYMORO's names, in small letters.
struct ParRow {
  std::string_view name;
  RowKey key;
};
constexpr std::array<ParRow, 14> kParBodyRows = {{{"m", RowKey::kM},
                                                  {"mx", RowKey::kMX},
                                                  {"my", RowKey::kMY},
                                                  {"mz", RowKey::kMZ},
                                                  {"xx", RowKey::kXX},
                                                  {"xy", RowKey::kXY},
                                                  {"xz", RowKey::kXZ},
                                                  {"yy", RowKey::kYY},
                                                  {"yz", RowKey::kYZ},
                                                  {"zz", RowKey::kZZ},
                                                  {"ia", RowKey::kIA},
                                                  {"fs", RowKey::kFs},
                                                  {"fv", RowKey::kFv},
                                                  {"off", RowKey::kOff}}};
/// Geometry, and what a robot file says elsewhere: external forces by --wrench.
constexpr std::array<std::string_view, 9> kParTable = {"ant", "sigma", "b",  "d",    "gamma",
                                                       "r",   "alpha", "mu", "theta"};
constexpr std::array<std::string_view, 15> kParPassed = {
    "fx", "fy", "fz", "cx", "cy", "cz", "qp", "qdp", "gam", "v0", "z", "num", "eta", "k", "q0"};

bool is_number_name(std::string_view name) {
  return name == "pi" || name == "sin" || name == "cos" || name == "sqrt";
}

/// The symbols of an expression: names that are no constants or functions.
std::vector<std::string> symbols_of(const std::string& text) {
  std::vector<std::string> symbols;
  for (std::size_t i = 0; i < text.size();) {
    if (!is_letter(text[i])) {
      // digits and the exponent behind them: 1e3
      if (is_digit(text[i])) {
        while (i < text.size() && (is_digit(text[i]) || text[i] == '.')) ++i;
        if (i + 1 < text.size() && (text[i] == 'e' || text[i] == 'E')) {
          const std::size_t digit = text[i + 1] == '-' || text[i + 1] == '+' ? i + 2 : i + 1;
          if (digit < text.size() && is_digit(text[digit])) i = digit;
        }
        continue;
      }
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    const std::string name = text.substr(i, end - i);
    if (!is_number_name(lower_case(name))) symbols.push_back(name);
    i = end;
  }
  return symbols;
}

class ParReader {
 public:
  ParReader(std::string text, const std::string& file_name)
      : text_(std::move(text)), file_name_(file_name), diagnostics_(file_name, text_) {}

  MadeText read() {
    for (ParAssignment& own : read_assignments(text_, diagnostics_, robot_name_)) {
      const std::string name = lower_case(own.name);
      const auto [first, is_first] = assignments_.try_emplace(name, std::move(own));
      if (!is_first) {
        diagnostics_.error(own.position, static_cast<int>(name.size()),
                           fmt::format("'{}' is assigned twice", name),
                           fmt::format("the first is on line {}", first->second.position.line));
      }
    }
    throw_if_wrong();
    check_kind();
    check_names();
    throw_if_wrong();
    make_rows();
    throw_if_wrong();
    MadeText made;
    made.text = robot_text();
    made.source_text = std::move(text_);
    made.place = [places = std::move(places_)](RowKey key, std::size_t column) {
      const auto found = places.find({key, column});
      return found == places.end() ? MadeText::Place{{1, 1}, 1} : found->second;
    };
    made.warnings = diagnostics_.all();
    return made;
  }

 private:
  using Column = std::vector<std::string>;

  void throw_if_wrong() const {
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
  }
  [[nodiscard]] const ParAssignment* find(const std::string& name) const {
    const auto found = assignments_.find(name);
    return found == assignments_.end() ? nullptr : &found->second;
  }
  void error(const ParValue& value, const std::string& message, const std::string& hint) {
    diagnostics_.error(value.position, value.length, message, hint);
  }

  /// An integer that stands alone.
  int integer(const std::string& name, int absent) {
    const ParAssignment* own = find(name);
    if (own == nullptr) return absent;
    const std::string& text = own->values.front().text;
    constexpr std::size_t kMostDigits = 4;
    const bool digits = !text.empty() && text.size() <= kMostDigits &&
                        std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c); });
    if (own->list || !digits) {
      error(own->values.front(), fmt::format("{} is '{}'", own->name, printable(text)),
            "expected an integer");
      return absent;
    }
    return std::stoi(text);
  }

  void refuse(const std::string& name, const std::string& message, const std::string& hint) {
    const ParAssignment* own = find(name);
    const SourcePosition position = own == nullptr ? SourcePosition{1, 1} : own->position;
    diagnostics_.error(position, static_cast<int>(name.size()), message, hint);
  }

  void check_kind() {
    links_ = integer("nl", 0);
    if (find("nl") == nullptr) {
      refuse("nl", "the file has no NL", "expected the number of links: NL = 6");
      return;
    }
    if (links_ < 1 || links_ > kMaxJoints) {
      refuse("nl", fmt::format("NL is {}", links_), fmt::format("expected 1 to {}", kMaxJoints));
    }
    constexpr int kClosedLoop = 2;  // SYMORO's Type: 0 simple, 1 tree, 2 closed loop
    const int joints = integer("nj", links_), frames = integer("nf", links_);
    if (integer("type", 0) == kClosedLoop || joints != links_ || frames != links_) {
      refuse(find("type") != nullptr ? "type" : "nj",
             fmt::format("a closed loop: NL = {}, NJ = {}, NF = {}", links_, joints, frames),
             "closed loops are not modelled: expected a chain or a tree");
    }
    for (const std::string name : {"is_mobile", "is_floating"}) {
      const ParAssignment* own = find(name);
      if (own == nullptr) continue;
      const std::string value = lower_case(own->values.front().text);
      if (value == "0" || value == "false") continue;
      refuse(
          name,
          fmt::format("{} is {}: a base that moves is not modelled", own->name, printable(value)),
          "expected a base that stands");
    }
    refuse_elastic_joints();
    for (const std::string name : {"w0", "wp0", "vp0"}) {
      const ParAssignment* own = find(name);
      if (own == nullptr) continue;
      for (const ParValue& value : own->values) {
        if (value.text == "0") continue;
        error(value, fmt::format("{} is not 0: a base that moves is not modelled", own->name),
              "expected 0, 0, 0; gravity stands in G");
      }
    }
  }

  void refuse_elastic_joints() {
    const ParAssignment* own = find("eta");
    if (own == nullptr) return;
    for (const ParValue& value : own->values) {
      if (value.text == "0") continue;
      error(value, fmt::format("eta is {}: an elastic joint", printable(value.text)),
            "expected 0: joints are rigid here; an effect row of the robot file adds elasticity");
    }
  }

  void check_names() {
    constexpr std::array<std::string_view, 11> kHeads = {
        "nl", "nj", "nf", "type", "is_mobile", "is_floating", "g", "w0", "wp0", "vp0", "robotname"};
    for (const auto& [name, own] : assignments_) {
      const auto stands_in = [&name = name](const auto& list) {
        return std::find(list.begin(), list.end(), name) != list.end();
      };
      const bool body = std::any_of(kParBodyRows.begin(), kParBodyRows.end(),
                                    [&name = name](const ParRow& row) { return row.name == name; });
      if (body || stands_in(kHeads) || stands_in(kParTable) || stands_in(kParPassed)) continue;
      diagnostics_.error(own.position, static_cast<int>(name.size()),
                         fmt::format("'{}' is unknown", printable(own.name)),
                         "expected ant sigma b d gamma r alpha mu theta, XX .. M, IA FV FS, G");
    }
  }

  /// The list of a name, of one value for each link; null if it is absent.
  const std::vector<ParValue>* list_of(const std::string& name, std::size_t wanted) {
    const ParAssignment* own = find(name);
    if (own == nullptr) return nullptr;
    if (own->list && own->values.size() == wanted) return &own->values;
    diagnostics_.error(own->position, static_cast<int>(own->name.size()),
                       fmt::format("{} has {} values", own->name, own->values.size()),
                       fmt::format("expected a list of {}", wanted));
    return nullptr;
  }

  /// A value as a robot file writes it: '*' for symbols where they may stand.
  std::string number(const ParValue& value, const std::string& name, bool may_be_unknown) {
    const std::vector<std::string> symbols = symbols_of(value.text);
    if (!symbols.empty()) {
      if (may_be_unknown) {
        if (value.text != symbols.front()) {
          diagnostics_.warning(value.position, value.length,
                               fmt::format("'{}' in {} becomes '*', one unknown number",
                                           printable(value.text), name),
                               "relations between symbols are not kept");
        }
        return "*";
      }
      error(value, fmt::format("'{}' in {} is a symbol", printable(symbols.front()), name),
            "expected a number: angles and joint types of a robot file are known");
      return "0";
    }
    std::string text = value.text;
    for (const std::string_view word : {"Pi", "PI", "Sin", "Cos", "Sqrt"}) {
      for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at)) {
        text.replace(at, word.size(), lower_case(word));
      }
    }
    for (std::size_t at = text.find("**"); at != text.npos; at = text.find("**")) {
      text.replace(at, 2, "^");
    }
    Word word{text, value.position, value.length};
    const LetNames none;
    if (!evaluate(word, name, none, diagnostics_).number) return "0";
    return text;
  }

  /// What is added to the joint's variable: "th2+pi/2" gives "pi/2".
  std::string offset(const ParValue& value, const std::string& name, bool may_be_unknown) {
    const std::vector<std::string> symbols = symbols_of(value.text);
    if (symbols.empty()) return number(value, name, may_be_unknown);
    const std::string& variable = symbols.front();
    std::string rest = value.text;
    const std::size_t at = rest.find(variable);
    const bool minus = at > 0 && rest[at - 1] == '-';
    const bool plus = at > 0 && rest[at - 1] == '+';
    const std::size_t behind = at + variable.size();
    const bool ends = behind == rest.size() || rest[behind] == '+' || rest[behind] == '-';
    if (symbols.size() > 1 || minus || !ends || (at > 0 && !plus)) {
      error(value,
            fmt::format("'{}' in {} is not the joint's variable plus a number",
                        printable(value.text), name),
            fmt::format("expected {}, or {}+pi/2", printable(variable), printable(variable)));
      return "0";
    }
    if (!variables_.insert(variable).second) {
      error(value, fmt::format("'{}' moves a second joint", printable(variable)),
            "expected a variable of each joint's own: joints that move together are not modelled");
    }
    rest.erase(plus ? at - 1 : at, variable.size() + (plus ? 1 : 0));
    if (rest.empty()) return "0";
    if (rest.front() == '+') rest.erase(0, 1);
    return number({rest, value.position, value.length}, name, may_be_unknown);
  }

  void put(RowKey key, std::size_t column, std::string text, const ParValue& origin) {
    rows_[key].resize(columns_, "0");
    rows_[key][column] = std::move(text);
    places_[{key, column}] = {origin.position, origin.length};
  }

  using Lists = std::map<std::string, const std::vector<ParValue>*>;

  void make_rows() {
    const auto wanted = static_cast<std::size_t>(links_);
    Lists lists;
    for (const std::string_view name : kParTable) {
      lists[std::string(name)] = list_of(std::string(name), wanted);
    }
    throw_if_wrong();
    const auto text_of = [&](const char* name, std::size_t link) -> std::string {
      return lists[name] == nullptr ? "0" : (*lists[name])[link].text;
    };
    // gamma and b are steps in front
    std::vector<std::size_t> place_of;  // of links, columns
    std::vector<bool> mounted;
    for (std::size_t link = 0; link < wanted; ++link) {
      const bool mount = text_of("gamma", link) != "0" || text_of("b", link) != "0";
      mounted.push_back(mount);
      columns_ += mount ? 1 : 0;
      place_of.push_back(columns_++);
    }
    for (std::size_t link = 0; link < wanted; ++link) {
      put_link(lists, link, place_of, mounted[link]);
    }
    for (const ParRow& row : kParBodyRows) put_body_row(row, place_of);
    make_gravity();
  }

  /// The columns of a link in the table of joints: its own, and the step in front of it.
  void put_link(Lists& lists, std::size_t link, const std::vector<std::size_t>& place_of,
                bool mounted) {
    const ParValue nowhere{"0", {1, 1}, 1};
    const auto value_of = [&](const char* name) -> const ParValue& {
      return lists[name] == nullptr ? nowhere : (*lists[name])[link];
    };
    const std::size_t own = place_of[link];
    const ParValue& type = value_of("sigma");
    const std::string sigma = number(type, "sigma", false);
    put(RowKey::kSigma, own, sigma, type);
    put(RowKey::kAnt, own, parent_of(lists["ant"], link, place_of, mounted), value_of("ant"));
    if (mounted) {
      const std::size_t before = own - 1;
      put(RowKey::kSigma, before, "2", type);
      put(RowKey::kAnt, before, parent_of(lists["ant"], link, place_of, false), value_of("ant"));
      put(RowKey::kTh, before, number(value_of("gamma"), "gamma", false), value_of("gamma"));
      put(RowKey::kR, before, number(value_of("b"), "b", true), value_of("b"));
    }
    put(RowKey::kAl, own, number(value_of("alpha"), "alpha", false), value_of("alpha"));
    put(RowKey::kD, own, number(value_of("d"), "d", true), value_of("d"));
    const ParValue& theta = value_of("theta");
    const ParValue& r = value_of("r");
    put(RowKey::kTh, own,
        sigma == "0" ? offset(theta, "theta", false) : number(theta, "theta", false), theta);
    put(RowKey::kR, own, sigma == "1" ? offset(r, "r", true) : number(r, "r", true), r);
  }

  void put_body_row(const ParRow& row, const std::vector<std::size_t>& place_of) {
    const std::string name(row.name);
    const std::vector<ParValue>* list = list_of(name, place_of.size());
    if (list == nullptr) return;
    const bool of_joint = row.key == RowKey::kIA || row.key == RowKey::kFs ||
                          row.key == RowKey::kFv || row.key == RowKey::kOff;
    for (std::size_t link = 0; link < place_of.size(); ++link) {
      const bool fixed = rows_[RowKey::kSigma][place_of[link]] == "2";
      const std::string text = number((*list)[link], find(name)->name, true);
      put(row.key, place_of[link], fixed && of_joint && text == "*" ? "0" : text, (*list)[link]);
    }
  }

  std::string parent_of(const std::vector<ParValue>* ant, std::size_t link,
                        const std::vector<std::size_t>& place_of, bool mounted) {
    if (mounted) return std::to_string(place_of[link]);  // the column in front, from 1
    if (ant == nullptr) return std::to_string(link == 0 ? 0 : place_of[link - 1] + 1);
    const ParValue& value = (*ant)[link];
    constexpr std::size_t kMostDigits = 3;
    const bool digits =
        !value.text.empty() && value.text.size() <= kMostDigits &&
        std::all_of(value.text.begin(), value.text.end(), [](char c) { return is_digit(c); });
    const std::size_t parent = digits ? std::stoul(value.text) : link + 1;
    if (parent > link) {
      error(value,
            fmt::format("the antecedent of link {} is '{}'", link + 1, printable(value.text)),
            fmt::format("expected a link before it, 0 (the base) to {}", link));
      return "0";
    }
    return std::to_string(parent == 0 ? 0 : place_of[parent - 1] + 1);
  }

  void make_gravity() {
    const std::vector<ParValue>* gravity = list_of("g", 3);
    if (gravity == nullptr) return;
    constexpr std::array<RowKey, 3> kKeys = {RowKey::kGx, RowKey::kGy, RowKey::kGz};
    for (std::size_t k = 0; k < 3; ++k) {
      const ParValue& value = (*gravity)[k];
      std::string text = number(value, "G", true);
      if (text == "0") continue;
      if (text == "*") {
        diagnostics_.warning(value.position, value.length,
                             fmt::format("'{}' in G is a symbol: {} is '*', the component of -G",
                                         printable(value.text), row_keyword(kKeys[k])),
                             "write the acceleration of gravity: -9.81 where z points up");
      } else {
        text = "-(" + text + ")";
      }
      gravity_[kKeys[k]] = text;
      places_[{kKeys[k], 0}] = {value.position, value.length};
    }
  }

  std::string robot_text() {
    std::string stem = std::filesystem::path(file_name_).stem().string();
    std::string name = robot_name_.empty() ? stem : robot_name_;
    name = identifier_of(name, "r");
    std::string text = fmt::format("# Made by dyngen of {} (SYMORO).\nname {}\nnumber_link {}\n",
                                   printable(std::filesystem::path(file_name_).filename().string()),
                                   name, columns_);
    for (const auto& [key, values] : rows_) {
      text += fmt::format("{:<6}", row_keyword(key));
      for (const std::string& value : values) text += fmt::format(" {:>8}", value);
      text += "\n";
    }
    for (const auto& [key, value] : gravity_) {
      text += fmt::format("{:<6} {}\n", row_keyword(key), value);
    }
    return text + "stop\n";
  }

  std::string text_;
  const std::string& file_name_;
  Diagnostics diagnostics_;
  std::string robot_name_;
  std::map<std::string, ParAssignment> assignments_;  // by names in small letters
  int links_ = 0;
  std::size_t columns_ = 0;
  std::set<std::string> variables_;  ///< of joints so far
  std::map<RowKey, Column> rows_;
  std::map<RowKey, std::string> gravity_;
  std::map<std::pair<RowKey, std::size_t>, MadeText::Place> places_;
};

}  // namespace

bool is_symoro_text(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kLettersOfBlanks);
  if (begin == text.npos) return false;
  if (text.substr(begin).starts_with("(*")) return true;
  std::size_t end = begin;
  while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
  const std::size_t next = text.find_first_not_of(kLettersOfBlanks, end);
  if (end == begin || next == text.npos || text[next] != '=') return false;
  constexpr std::array<std::string_view, 8> kFirst = {"nl",        "nj",          "nf",  "type",
                                                      "is_mobile", "is_floating", "ant", "sigma"};
  const std::string name = lower_case(text.substr(begin, end - begin));
  return std::find(kFirst.begin(), kFirst.end(), name) != kFirst.end();
}

MadeText read_par(std::string text, const std::string& file_name) {
  return ParReader(std::move(text), file_name).read();
}

}  // namespace dyngen
