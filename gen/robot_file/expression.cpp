// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "gen/words/spelling.h"

namespace dyngen {

namespace {

constexpr int kMaxDepth = 200;  // of parentheses, signs and powers: the parser's own stack

constexpr std::array<std::string_view, 2> kConstants = {"pi", "deg"};
constexpr std::array<std::string_view, 3> kFunctions = {"sqrt", "sin", "cos"};

bool is_one_of(std::string_view name, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What is wrong with a value, and with which of its characters.
struct ValueError {
  std::size_t offset = 0;
  std::size_t length = 1;
  std::string message;
  std::string hint = {};
  bool cut_off = false;
};

/// Thrown where a value leans on one that is reported already.
struct AlreadyReported {};

constexpr std::string_view kNumberForms = "numbers look like 2, 0.5, .5, 1e-3";
constexpr std::string_view kNoBlanks = "a value holds no blanks: pi/2, not pi / 2";

/// Whether as many are opened as closed; if not, the value was torn apart at a blank or comma:
/// atan2(1,2).
bool has_all_parentheses(std::string_view value) {
  return std::count(value.begin(), value.end(), '(') == std::count(value.begin(), value.end(), ')');
}

/// Recursive descent, one function per level of the grammar:
///
///     sum     = product { (+|-) product }
///     product = signed { (*|/) signed }
///     signed  = (+|-) signed | power
///     power   = primary [ ^ signed ]                 2^-1, and 2^3^2 = 2^9
///     primary = number | name | function ( sum ) | ( sum )
class ValueParser {
 public:
  ValueParser(const Word& word, std::string_view row, const LetNames& names)
      : word_(word), row_(row), names_(names), tokens_(split_tokens(word.text)) {}

  ExactNumber parse() {
    ExactNumber value = sum();
    if (peek().kind != TokenKind::kEnd) throw surplus();
    return value;
  }

 private:
  const Token& peek() const { return tokens_[next_]; }
  bool at(std::string_view symbol) const {
    return peek().kind == TokenKind::kSymbol && peek().text == symbol;
  }
  const Token& take() { return tokens_[next_++]; }

  ExactNumber sum() {
    ExactNumber value = product();
    while (at("+") || at("-")) {
      const Token& op = take();
      const ExactNumber right = product();
      value = computed(op, [&] { return op.text == "+" ? value + right : value - right; });
    }
    return value;
  }

  ExactNumber product() {
    ExactNumber value = with_sign();
    while (at("*") || at("/")) {
      const Token& op = take();
      const ExactNumber right = with_sign();
      value = computed(op, [&] { return op.text == "*" ? value * right : value / right; });
    }
    return value;
  }

  ExactNumber with_sign() {
    if (++depth_ > kMaxDepth) {
      throw ValueError{peek().offset, 1, "the value is nested too deeply",
                       fmt::format("at most {} levels", kMaxDepth)};
    }
    ExactNumber value;
    if (at("+")) {
      take();
      value = with_sign();
    } else if (at("-")) {
      const Token& op = take();
      value = with_sign();
      value = computed(op, [&] { return -value; });
    } else {
      value = raised();
    }
    --depth_;
    return value;
  }

  ExactNumber raised() {
    ExactNumber value = primary();
    if (!at("^")) return value;
    const Token& op = take();
    const ExactNumber exponent = with_sign();
    return computed(op, [&] { return power(value, exponent); });
  }

  ExactNumber primary() {
    const Token& token = peek();
    if (token.kind == TokenKind::kNumber) {
      take();
      return computed(token, [&] { return ExactNumber::from_decimal(token.text); });
    }
    if (token.kind == TokenKind::kName) return named();
    if (at("(")) return parenthesis();
    throw misplaced();
  }

  ExactNumber parenthesis() {
    const Token& open = take();
    ExactNumber value = sum();
    if (at(")")) {
      take();
      return value;
    }
    if (peek().kind != TokenKind::kEnd) throw surplus();
    throw ValueError{open.offset, 1, fmt::format("'(' without ')' in '{}'", row_),
                     std::string(kNoBlanks), true};
  }

  ExactNumber named() {
    const Token& name = take();
    const bool is_call = at("(");
    if (is_one_of(name.text, kFunctions)) {
      if (!is_call) {
        const bool cut_off = peek().kind == TokenKind::kEnd;
        throw ValueError{name.offset, name.text.size(),
                         fmt::format("expected '(' after '{}'", name.text),
                         fmt::format("write {}(...), without blanks", name.text), cut_off};
      }
      const ExactNumber argument = parenthesis();
      return computed(name, [&] {
        if (name.text == "sqrt") return square_root(argument);
        return name.text == "sin" ? sine(argument) : cosine(argument);
      });
    }
    if (is_call) throw unknown_function(name);
    if (name.text == "pi") return ExactNumber::pi();
    if (name.text == "deg") return ExactNumber::degree();
    const LetNames::Entry* entry = names_.find(name.text);
    if (entry == nullptr) throw unknown_symbol(name);
    if (!entry->value) throw AlreadyReported{};
    return *entry->value;
  }

  /// The result of an operation; what goes wrong in it is put at the operation's token.
  template <typename Operation>
  ExactNumber computed(const Token& token, Operation operation) const {
    const auto wrong = [&](const std::string& message, const std::string& hint) {
      return ValueError{token.offset, token.text.size(), fmt::format("{} in '{}'", message, row_),
                        hint};
    };
    try {
      return operation();
    } catch (const ArithmeticError& error) {
      throw wrong(error.what(), error.hint());
    } catch (const std::exception&) {  // GiNaC and CLN have errors of their own
      throw wrong("the value cannot be worked out", "");
    }
  }

  /// What to say of a token where an operand belongs.
  ValueError misplaced() const {
    const Token& token = peek();
    if (token.kind == TokenKind::kMalformed) {
      return {token.offset, token.text.size(),
              fmt::format("'{}' is not a number", printable(token.text)),
              std::string(kNumberForms)};
    }
    if (token.kind == TokenKind::kEnd) {
      if (next_ == 0) {  // of a list in another format: {1,,3}
        return {token.offset, 1, fmt::format("expected a value in '{}', found nothing", row_),
                std::string(kNumberForms)};
      }
      const Token& before = tokens_[next_ - 1];
      return {before.offset, 1,
              fmt::format("expected a value after '{}' in '{}'", before.text, row_),
              std::string(kNoBlanks), true};
    }
    if (token.text == "=") {
      return {token.offset, 1, fmt::format("unexpected '=' in '{}'", row_),
              "values follow their keyword or name without '='", true};
    }
    if (token.text == "*" && at_doubled_star()) {
      return {token.offset, 1, fmt::format("unexpected '*' in '{}'", row_), "a power is written ^"};
    }
    const bool cut_off = next_ == 0;
    return {
        token.offset, 1,
        fmt::format("expected a value {} '{}' in '{}'",
                    token.text == ")" || next_ == 0 ? "before" : "instead of", token.text, row_),
        cut_off ? std::string(kNoBlanks) : "", cut_off};
  }

  bool at_doubled_star() const { return next_ > 0 && tokens_[next_ - 1].text == "*"; }

  /// What to say of a token after a complete value.
  ValueError surplus() const {
    const Token& token = peek();
    const Token& before = tokens_[next_ - 1];
    if (token.kind == TokenKind::kMalformed) return misplaced();
    if (token.text == ")") {
      return {token.offset, 1, fmt::format("')' without '(' in '{}'", row_), std::string(kNoBlanks),
              true};
    }
    if (token.text == "=" || token.text == "'") {
      return {token.offset, 1,
              fmt::format("unexpected {} in '{}'", token.text == "=" ? "'='" : "apostrophe", row_),
              "only effects have settings, NAME=VALUE"};
    }
    const bool is_value = token.kind != TokenKind::kName || is_builtin_name(token.text) ||
                          names_.find(token.text) != nullptr;
    return {token.offset, token.text.size(),
            fmt::format("expected an operator between '{}' and '{}' in '{}'",
                        printable(before.text), printable(token.text), row_),
            is_value ? fmt::format("write {}*{}", printable(before.text), printable(token.text))
                     : std::string(kNumberForms)};
  }

  ValueError unknown_function(const Token& name) const {
    const std::string shown = printable(name.text);
    if (is_one_of(name.text, kConstants) || names_.find(name.text) != nullptr) {
      return {name.offset, name.text.size(),
              fmt::format("'{}' in '{}' is not a function", shown, row_),
              fmt::format("write {}*(...) for a product", shown)};
    }
    return {name.offset, name.text.size(),
            fmt::format("unknown function '{}' in '{}'", shown, row_),
            fmt::format("the functions are {}", comma_list(kFunctions))};
  }

  ValueError unknown_symbol(const Token& name) const {
    const std::string shown = printable(name.text);
    ValueError error{name.offset, name.text.size(),
                     fmt::format("unknown symbol '{}' in '{}'", shown, row_)};
    const std::string lower = lower_case(name.text);
    const std::optional<SourcePosition> later = names_.announced(name.text);
    if (later && later->line == word_.position.line && row_ == name.text) {
      error.message = fmt::format("'{}' is defined by itself", shown);
      error.hint = "a let row may use earlier let names only";
    } else if (later) {
      error.message =
          fmt::format("'{}' in '{}' is declared only later, on line {}", shown, row_, later->line);
      error.hint = "a value may use earlier let names only: move that row up";
    } else if (lower == "nan" || lower == "inf" || lower == "infinity") {
      error.message = fmt::format("'{}' in '{}' is not a finite number", shown, row_);
      error.hint = "leave the row out if there is no limit";
    } else {
      error.hint = declared_names(name.text);
    }
    return error;
  }

  std::string declared_names(std::string_view wanted) const {
    std::vector<std::string_view> names;
    for (const LetNames::Entry& entry : names_.all()) names.push_back(entry.name);
    std::string declared =
        names.empty() ? "no let names are declared above" : "declared: " + comma_list(names);
    names.insert(names.end(), kConstants.begin(), kConstants.end());
    const std::string_view nearest = nearest_word(wanted, names);
    if (nearest.empty()) return declared;
    return fmt::format("did you mean '{}'? {}", printable(nearest), declared);
  }

  const Word& word_;
  std::string_view row_;
  const LetNames& names_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
  int depth_ = 0;
};

}  // namespace

bool LetNames::declare(std::string_view name, SourcePosition position,
                       std::optional<ExactNumber> value) {
  if (!places_.emplace(name, entries_.size()).second) return false;
  entries_.push_back({std::string(name), position, std::move(value)});
  return true;
}

void LetNames::announce(std::string_view name, SourcePosition position) {
  announced_.emplace(name, position);
}

const LetNames::Entry* LetNames::find(std::string_view name) const {
  const auto place = places_.find(name);
  return place == places_.end() ? nullptr : &entries_[place->second];
}

std::optional<SourcePosition> LetNames::announced(std::string_view name) const {
  const auto found = announced_.find(name);
  if (found == announced_.end()) return std::nullopt;
  return found->second;
}

void LetNames::mark_used(std::string_view value) {
  for (const Token& token : split_tokens(value)) {
    if (token.kind != TokenKind::kName) continue;
    const auto place = places_.find(token.text);
    if (place != places_.end()) entries_[place->second].used = true;
  }
}

bool is_builtin_name(std::string_view word) {
  const std::string lower = lower_case(word);
  return is_one_of(lower, kConstants) || is_one_of(lower, kFunctions);
}

bool begins_with_known_name(std::string_view value, const LetNames& names) {
  const Token first = split_tokens(value).front();
  return first.kind == TokenKind::kName &&
         (is_builtin_name(first.text) || names.find(first.text) != nullptr);
}

Evaluation evaluate(const Word& word, std::string_view row, const LetNames& names,
                    Diagnostics& diagnostics) {
  const auto at = [&](std::size_t offset) {  // a word without bad characters is ASCII
    return SourcePosition{word.position.line, word.position.column + static_cast<int>(offset)};
  };
  try {
    const ExactNumber number = ValueParser(word, row, names).parse();
    if (number.fits_double()) return {number};
    diagnostics.error(word.position, word.length,
                      fmt::format("the value in '{}' is outside the range of double", row),
                      "numbers lie between 2.3e-308 and 1.7e308");
    return {};
  } catch (const ValueError& error) {
    diagnostics.error(at(error.offset), static_cast<int>(error.length), error.message, error.hint);
    return {std::nullopt, error.cut_off || !has_all_parentheses(word.text)};
  } catch (const AlreadyReported&) {
    return {};
  }
}

}  // namespace dyngen
