// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/expression_units.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen {
namespace {

using Kind = EffectExpression::Kind;
constexpr Dimension kNumber{};

bool is_zero_number(const EffectExpression& expression) {
  return expression.kind == Kind::kNumber && expression.number.is_zero();
}

/// The number that an exponent is; none if it is made of names.
std::optional<double> plain_value(const EffectExpression& expression) {
  if (!is_plain_number(expression)) return std::nullopt;
  const GiNaC::ex value = to_algebra(expression, [](const std::string&) { return GiNaC::ex(0); });
  const GiNaC::ex number = value.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(number)) return std::nullopt;
  return GiNaC::ex_to<GiNaC::numeric>(number).to_double();
}

class Inference {
 public:
  Inference(const DimensionOfName& of_name, Diagnostics& diagnostics)
      : of_name_(of_name), diagnostics_(diagnostics) {}

  std::optional<Dimension> run(const EffectExpression& expression) {
    switch (expression.kind) {
      case Kind::kNumber:
        return kNumber;
      case Kind::kName:
        return expression.name == "pi" ? kNumber : of_name_(expression.name);
      case Kind::kNegate:
        return run(expression.operands[0]);
      case Kind::kSum:
      case Kind::kDifference:
        return alike(expression, fmt::format("the two sides of '{}'",
                                             expression.kind == Kind::kSum ? "+" : "-"));
      case Kind::kProduct:
      case Kind::kQuotient: {
        const auto a = run(expression.operands[0]), b = run(expression.operands[1]);
        if (!a || !b) return std::nullopt;
        return expression.kind == Kind::kProduct ? *a + *b : *a - *b;
      }
      case Kind::kPower:
        return power(expression);
      case Kind::kCall:
        return call(expression);
    }
    return std::nullopt;
  }

 private:
  void error(const EffectExpression& at, const std::string& message, const std::string& hint) {
    diagnostics_.error(at.position, at.length, message, hint);
  }

  std::optional<Dimension> alike(const EffectExpression& expression, const std::string& what) {
    const auto a = run(expression.operands[0]), b = run(expression.operands[1]);
    if (!a || !b) return std::nullopt;
    if (is_zero_number(expression.operands[0])) return b;
    if (is_zero_number(expression.operands[1]) || *a == *b) return a;
    error(expression,
          fmt::format("{} have units {} and {}", what, dimension_text(*a), dimension_text(*b)),
          "only equal units can be added or compared");
    return std::nullopt;
  }

  std::optional<Dimension> power(const EffectExpression& expression) {
    const auto base = run(expression.operands[0]), exponent = run(expression.operands[1]);
    if (!base || !exponent) return std::nullopt;
    if (*exponent != kNumber) {
      error(expression, fmt::format("an exponent has the unit {}", dimension_text(*exponent)),
            "expected a pure number");
      return std::nullopt;
    }
    if (*base == kNumber) return kNumber;
    if (const std::optional<double> value = plain_value(expression.operands[1])) {
      return *base * *value;
    }
    error(expression,
          fmt::format("a power of {} with an exponent that is no fixed number",
                      dimension_text(*base)),
          "divide the base by something of its unit first");
    return std::nullopt;
  }

  std::optional<Dimension> call(const EffectExpression& expression) {
    const std::string& name = expression.name;
    if (name == "min" || name == "max") {
      return alike(expression, fmt::format("the arguments of '{}'", name));
    }
    const auto argument = run(expression.operands[0]);
    if (!argument || name == "abs") return argument;
    if (name == "sign") return kNumber;
    if (name == "sqrt") return *argument * 0.5;
    if (*argument == kNumber) return kNumber;
    error(expression,
          fmt::format("the argument of '{}' has the unit {}", name, dimension_text(*argument)),
          "expected a pure number or an angle");
    return std::nullopt;
  }

  const DimensionOfName& of_name_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool is_plain_number(const EffectExpression& expression) {
  const std::vector<std::string> names = names_in(expression);
  return std::all_of(names.begin(), names.end(),
                     [](const std::string& name) { return name == "pi"; });
}

std::optional<Dimension> dimension_of(const EffectExpression& expression,
                                      const DimensionOfName& dimension_of_name,
                                      Diagnostics& diagnostics) {
  return Inference(dimension_of_name, diagnostics).run(expression);
}

}  // namespace dyngen
