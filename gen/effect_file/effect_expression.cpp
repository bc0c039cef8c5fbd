// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/diagnostic/utf8.h"
#include "gen/robot_file/exact_number.h"
#include "gen/robot_file/lexer.h"
#include "gen/symbols/calls.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

using GiNaC::ex;
using Kind = EffectExpression::Kind;

struct EffectCall {
  std::string_view name;
  int arguments;
};
constexpr std::array<EffectCall, 10> kEffectCalls = {{{"sin", 1},
                                                      {"cos", 1},
                                                      {"exp", 1},
                                                      {"log", 1},
                                                      {"tanh", 1},
                                                      {"sqrt", 1},
                                                      {"abs", 1},
                                                      {"sign", 1},
                                                      {"min", 2},
                                                      {"max", 2}}};
constexpr int kMostDepth = 100;

struct PlacedToken {
  TokenKind kind = TokenKind::kEnd;
  std::string text;
  SourcePosition position;
};

/// What is wrong, where: thrown out of the descent.
struct Wrong {
  PlacedToken token;
  std::string message;
  std::string hint;
};

std::vector<PlacedToken> tokens_of(const std::vector<EffectText>& pieces) {
  std::vector<PlacedToken> tokens;
  SourcePosition end;
  for (const EffectText& piece : pieces) {
    for (const Token& token : split_tokens(piece.text)) {
      const std::string_view before = std::string_view(piece.text).substr(0, token.offset);
      const SourcePosition place{piece.position.line,
                                 piece.position.column + character_count(before)};
      end = place;
      if (token.kind == TokenKind::kEnd || token.text == " " || token.text == "\t") continue;
      tokens.push_back({token.kind, std::string(token.text), place});
    }
  }
  tokens.push_back({TokenKind::kEnd, "", end});
  return tokens;
}

/// sum = product {(+|-) product}; product = signed {(*|/) signed}; signed = (+|-) signed | power;
/// power = primary [^ signed]; primary = number | name | name ( sum {, sum} ) | ( sum )
class Descent {
 public:
  Descent(std::vector<PlacedToken> tokens, std::string row)
      : tokens_(std::move(tokens)), row_(std::move(row)) {}

  EffectExpression run() {
    EffectExpression result = sum();
    if (peek().kind != TokenKind::kEnd) {
      throw Wrong{peek(), fmt::format("'{}' has no place here in '{}'", shown(), row_),
                  "expected an operator or the end of the expression"};
    }
    return result;
  }

 private:
  [[nodiscard]] const PlacedToken& peek() const { return tokens_[next_]; }
  [[nodiscard]] bool at(std::string_view symbol) const {
    return peek().kind == TokenKind::kSymbol && peek().text == symbol;
  }
  [[nodiscard]] std::string shown() const { return printable(peek().text); }
  const PlacedToken& take() { return tokens_[next_++]; }

  EffectExpression binary(Kind kind, EffectExpression a, const PlacedToken& token,
                          EffectExpression b) {
    EffectExpression result;
    result.kind = kind;
    result.position = token.position;
    result.operands.push_back(std::move(a));
    result.operands.push_back(std::move(b));
    return result;
  }

  EffectExpression sum() {
    EffectExpression result = product();
    while (at("+") || at("-")) {
      const PlacedToken token = take();
      result = binary(token.text == "+" ? Kind::kSum : Kind::kDifference, std::move(result), token,
                      product());
    }
    return result;
  }

  EffectExpression product() {
    EffectExpression result = with_sign();
    while (at("*") || at("/")) {
      const PlacedToken token = take();
      result = binary(token.text == "*" ? Kind::kProduct : Kind::kQuotient, std::move(result),
                      token, with_sign());
    }
    return result;
  }

  EffectExpression with_sign() {
    if (++depth_ > kMostDepth) {
      throw Wrong{peek(), fmt::format("the expression of '{}' is nested too deeply", row_),
                  "name parts of it by rows 'let'"};
    }
    EffectExpression result;
    if (at("+")) {
      take();
      result = with_sign();
    } else if (at("-")) {
      const PlacedToken token = take();
      result.kind = Kind::kNegate;
      result.position = token.position;
      result.operands.push_back(with_sign());
    } else {
      result = raised();
    }
    --depth_;
    return result;
  }

  EffectExpression raised() {
    EffectExpression base = primary();
    if (!at("^")) return base;
    const PlacedToken token = take();
    return binary(Kind::kPower, std::move(base), token, with_sign());
  }

  EffectExpression primary() {
    const PlacedToken token = peek();
    if (token.kind == TokenKind::kNumber) return number();
    if (token.kind == TokenKind::kName) return named();
    if (at("(")) {
      take();
      EffectExpression inner = sum();
      close(token);
      return inner;
    }
    if (token.kind == TokenKind::kEnd) {
      throw Wrong{token, fmt::format("the expression of '{}' ends too early", row_),
                  "expected a number, a name or '('"};
    }
    throw Wrong{token, fmt::format("'{}' has no place here in '{}'", shown(), row_),
                "expected a number, a name or '('"};
  }

  void close(const PlacedToken& open) {
    if (at(")")) {
      take();
      return;
    }
    if (peek().kind == TokenKind::kEnd) {
      throw Wrong{open, fmt::format("'(' without ')' in '{}'", row_), ""};
    }
    throw Wrong{peek(), fmt::format("'{}' has no place here in '{}'", shown(), row_),
                "expected ')' or an operator"};
  }

  EffectExpression number() {
    const PlacedToken token = take();
    EffectExpression result;
    result.position = token.position;
    result.length = static_cast<int>(token.text.size());
    try {
      result.number = ExactNumber::from_decimal(token.text).exact();
      result.value = GiNaC::ex_to<GiNaC::numeric>(result.number).to_double();
    } catch (const ArithmeticError& error) {
      throw Wrong{token, error.what(), error.hint()};
    }
    return result;
  }

  EffectExpression named() {
    const PlacedToken token = take();
    EffectExpression result;
    result.position = token.position;
    result.length = static_cast<int>(token.text.size());
    result.name = token.text;
    result.kind = Kind::kName;
    const int expected = effect_call_arguments(token.text);
    if (!at("(")) {
      if (expected == 0) return result;
      throw Wrong{token, fmt::format("expected '(' after '{}'", token.text),
                  fmt::format("{} is a function", token.text)};
    }
    if (expected == 0) throw unknown_function(token);
    const PlacedToken open = take();
    result.kind = Kind::kCall;
    result.operands.push_back(sum());
    while (at(",")) {
      take();
      result.operands.push_back(sum());
    }
    close(open);
    if (static_cast<int>(result.operands.size()) != expected) {
      throw Wrong{
          token,
          fmt::format("{} has {} argument{}, expected {}", token.text, result.operands.size(),
                      result.operands.size() == 1 ? "" : "s", expected),
          ""};
    }
    return result;
  }

  static Wrong unknown_function(const PlacedToken& token) {
    std::vector<std::string_view> names;
    for (const EffectCall& call : kEffectCalls) names.push_back(call.name);
    const std::string_view near = nearest_word(token.text, names);
    return Wrong{token, fmt::format("unknown function '{}'", printable(token.text)),
                 near.empty() ? "known functions: " + comma_list(names)
                              : fmt::format("did you mean '{}'?", near)};
  }

  std::vector<PlacedToken> tokens_;
  std::string row_;
  std::size_t next_ = 0;
  int depth_ = 0;
};

int precedence(Kind kind) {
  switch (kind) {
    case Kind::kSum:
    case Kind::kDifference:
      return 1;
    case Kind::kNegate:
      return 2;
    case Kind::kProduct:
    case Kind::kQuotient:
      return 3;
    case Kind::kPower:
      return 4;
    default:
      return 5;
  }
}

std::string_view operator_text(Kind kind) {
  switch (kind) {
    case Kind::kSum:
      return " + ";
    case Kind::kDifference:
      return " - ";
    case Kind::kProduct:
      return "*";
    case Kind::kQuotient:
      return "/";
    default:
      return "^";
  }
}

void collect_names(const EffectExpression& expression, std::vector<std::string>& names) {
  if (expression.kind == Kind::kName &&
      std::find(names.begin(), names.end(), expression.name) == names.end()) {
    names.push_back(expression.name);
  }
  for (const EffectExpression& operand : expression.operands) collect_names(operand, names);
}

ex raise(const ex& base, const ex& exponent) {
  constexpr int kMostProduct = 8;
  if (exponent.info(GiNaC::info_flags::integer) && exponent <= kMostProduct &&
      exponent >= -kMostProduct) {
    return GiNaC::pow(base, exponent);
  }
  return real_pow(base, exponent);
}

double call_value(const std::string& name, double a, double b) {
  if (name == "sin") return std::sin(a);
  if (name == "cos") return std::cos(a);
  if (name == "exp") return std::exp(a);
  if (name == "log") return std::log(a);
  if (name == "tanh") return std::tanh(a);
  if (name == "sqrt") return std::sqrt(a);
  if (name == "abs") return std::abs(a);
  if (name == "sign") return static_cast<double>((a > 0) - (a < 0));
  if (name == "min") return std::min(a, b);
  DYNGEN_ASSERT(name == "max", name);
  return std::max(a, b);
}

bool is_own_velocity(const EffectExpression& expression) {
  return expression.kind == Kind::kName && expression.name == "qd";
}

}  // namespace

int effect_call_arguments(const std::string& name) {
  const auto found = std::find_if(kEffectCalls.begin(), kEffectCalls.end(),
                                  [&](const EffectCall& call) { return call.name == name; });
  return found == kEffectCalls.end() ? 0 : found->arguments;
}

EffectExpression parse_effect_expression(const std::vector<EffectText>& pieces,
                                         const std::string& row, Diagnostics& diagnostics) {
  try {
    return Descent(tokens_of(pieces), row).run();
  } catch (const Wrong& wrong) {
    diagnostics.error(wrong.token.position, std::max(1, character_count(wrong.token.text)),
                      wrong.message, wrong.hint);
    return {};
  }
}

std::vector<std::string> names_in(const EffectExpression& expression) {
  std::vector<std::string> names;
  collect_names(expression, names);
  return names;
}

ex to_algebra(const EffectExpression& expression,
              const std::function<ex(const std::string&)>& value_of) {
  if (expression.kind == Kind::kNumber) return expression.number;
  if (expression.kind == Kind::kName) {
    return expression.name == "pi" ? ex(GiNaC::Pi) : value_of(expression.name);
  }
  if (expression.kind == Kind::kCall && expression.name == "sign" &&
      is_own_velocity(expression.operands[0])) {
    return value_of("sign_qd");
  }
  std::vector<ex> operands;
  for (const EffectExpression& operand : expression.operands) {
    operands.push_back(to_algebra(operand, value_of));
  }
  switch (expression.kind) {
    case Kind::kNegate:
      return -operands[0];
    case Kind::kSum:
      return operands[0] + operands[1];
    case Kind::kDifference:
      return operands[0] - operands[1];
    case Kind::kProduct:
      return operands[0] * operands[1];
    case Kind::kQuotient:
      return operands[0] / operands[1];
    case Kind::kPower:
      return raise(operands[0], operands[1]);
    default:
      DYNGEN_ASSERT(expression.kind == Kind::kCall, "an expression of effects");
      return make_call(expression.name, operands);
  }
}

double evaluate(const EffectExpression& expression,
                const std::function<double(const std::string&)>& value_of) {
  if (expression.kind == Kind::kNumber) return expression.value;
  if (expression.kind == Kind::kName) {
    return expression.name == "pi" ? std::numbers::pi : value_of(expression.name);
  }
  const double a = evaluate(expression.operands[0], value_of);
  const double b =
      expression.operands.size() > 1 ? evaluate(expression.operands[1], value_of) : 0.0;
  switch (expression.kind) {
    case Kind::kNegate:
      return -a;
    case Kind::kSum:
      return a + b;
    case Kind::kDifference:
      return a - b;
    case Kind::kProduct:
      return a * b;
    case Kind::kQuotient:
      return a / b;
    case Kind::kPower:
      return std::pow(a, b);
    default:
      return call_value(expression.name, a, b);
  }
}

std::string spell(const EffectExpression& expression) {
  const auto operand = [&](std::size_t i, bool right) {
    const EffectExpression& inner = expression.operands[i];
    const int own = precedence(expression.kind), its = precedence(inner.kind);
    const bool brackets = its < own || (right && its == own) ||
                          (expression.kind == Kind::kPower && its <= own) ||
                          (right && inner.kind == Kind::kNegate);
    return brackets ? "(" + spell(inner) + ")" : spell(inner);
  };
  switch (expression.kind) {
    case Kind::kNumber:
      return fmt::format("{}", expression.value);
    case Kind::kName:
      return expression.name;
    case Kind::kNegate:
      return "-" + operand(0, true);
    case Kind::kCall: {
      std::string text = expression.name + "(";
      for (std::size_t i = 0; i < expression.operands.size(); ++i) {
        text += (i > 0 ? ", " : "") + spell(expression.operands[i]);
      }
      return text + ")";
    }
    default:
      return operand(0, false) + std::string(operator_text(expression.kind)) + operand(1, true);
  }
}

}  // namespace dyngen
