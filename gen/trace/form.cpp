// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/form.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

constexpr int kMaxExponent = 64;

/// What the operands of a sum or product are sorted by.
struct Key {
  int last = -1;            // the latest symbol in it
  std::vector<int> places;  // all symbols, as the form lists them
  std::string numbers;      // text, for what the places leave open

  auto tie() const { return std::tie(last, places, numbers); }
};

void collect_key(const Form& form, const SymbolTable& symbols, Key& key) {
  switch (form.kind) {
    case Form::Kind::kNumber:
      key.numbers += shortest_decimal(form.leaf) + " ";
      break;
    case Form::Kind::kSymbol:
      key.places.push_back(symbols.place(form.leaf));
      key.last = std::max(key.last, key.places.back());
      break;
    case Form::Kind::kCall:
      key.numbers += form.call + " ";
      [[fallthrough]];
    case Form::Kind::kSum:
    case Form::Kind::kProduct:
    case Form::Kind::kQuotient:
      if (form.kind == Form::Kind::kQuotient) key.numbers += "/ ";
      for (const Form& part : form.parts) collect_key(part, symbols, key);
      for (const bool negative : form.negative) key.numbers += negative ? "-" : "+";
      break;
  }
}

struct Operand {
  bool negative = false;
  Form form;
  Key key;
};

Operand make_operand(bool negative, Form form, const SymbolTable& symbols) {
  Operand operand{negative, std::move(form), {}};
  collect_key(operand.form, symbols, operand.key);
  return operand;
}

Operand signed_form(const ex& expression, const SymbolTable& symbols);

Form number_form(const ex& value) {
  Form form;
  form.leaf = value;
  return form;
}

/// The factors of a product, those of its denominator apart.
struct Factors {
  std::vector<Operand> numerator;
  std::vector<Operand> denominator;
  bool negative = false;
};

void add_factor(const ex& factor, const SymbolTable& symbols, Factors& factors) {
  int repeat = 1;
  bool divides = false;
  ex base = factor;
  if (GiNaC::is_a<GiNaC::power>(factor) && !is_number(factor)) {
    const ex exponent = factor.op(1);
    DYNGEN_ASSERT(exponent.info(GiNaC::info_flags::integer) && exponent <= kMaxExponent &&
                      exponent >= -kMaxExponent,
                  "only small whole powers occur in a program");
    repeat = GiNaC::ex_to<GiNaC::numeric>(exponent).to_int();
    divides = repeat < 0;
    repeat = std::abs(repeat);
    base = factor.op(0);
  }
  const Operand operand = signed_form(base, symbols);
  if (operand.negative && repeat % 2 == 1) factors.negative = !factors.negative;
  if (operand.form.kind == Form::Kind::kNumber && operand.form.leaf.is_equal(1)) return;
  auto& side = divides ? factors.denominator : factors.numerator;
  for (int i = 0; i < repeat; ++i) side.push_back(operand);
}

Form product_of(std::vector<Operand> factors) {
  std::sort(factors.begin(), factors.end(), [](const Operand& a, const Operand& b) {
    return std::tie(a.key.places, a.key.numbers) < std::tie(b.key.places, b.key.numbers);
  });
  if (factors.empty()) return number_form(1);
  if (factors.size() == 1) return std::move(factors[0].form);
  Form form;
  form.kind = Form::Kind::kProduct;
  for (Operand& factor : factors) form.parts.push_back(std::move(factor.form));
  return form;
}

/// A product, a power (a product of one kind of factor), or a quotient of such.
Operand product_form(const ex& product, const SymbolTable& symbols) {
  Factors factors;
  if (GiNaC::is_a<GiNaC::mul>(product)) {
    for (std::size_t i = 0; i < product.nops(); ++i) {
      add_factor(product.op(i), symbols, factors);
    }
  } else {
    add_factor(product, symbols, factors);
  }
  Form numerator = product_of(std::move(factors.numerator));
  if (factors.denominator.empty()) {
    return make_operand(factors.negative, std::move(numerator), symbols);
  }
  Form quotient;
  quotient.kind = Form::Kind::kQuotient;
  quotient.parts.push_back(std::move(numerator));
  quotient.parts.push_back(product_of(std::move(factors.denominator)));
  return make_operand(factors.negative, std::move(quotient), symbols);
}

std::vector<Operand> sorted_terms(const ex& sum, const SymbolTable& symbols) {
  std::vector<Operand> terms;
  if (GiNaC::is_a<GiNaC::add>(sum)) {
    for (std::size_t i = 0; i < sum.nops(); ++i) {
      terms.push_back(signed_form(sum.op(i), symbols));
    }
  } else {
    terms.push_back(signed_form(sum, symbols));
  }
  std::sort(terms.begin(), terms.end(),
            [](const Operand& a, const Operand& b) { return a.key.tie() < b.key.tie(); });
  return terms;
}

Form sum_of(std::vector<Operand> terms) {
  const auto positive =
      std::find_if(terms.begin(), terms.end(), [](const Operand& term) { return !term.negative; });
  if (positive != terms.end()) std::rotate(terms.begin(), positive, positive + 1);
  Form form;
  form.kind = Form::Kind::kSum;
  for (Operand& term : terms) {
    form.parts.push_back(std::move(term.form));
    form.negative.push_back(term.negative);
  }
  return form;
}

Form sum_form(const ex& sum, const SymbolTable& symbols) {
  return sum_of(sorted_terms(sum, symbols));
}

/// A sum inside a product. GiNaC may hold a (b - c) as -a (c - b), one way or the other from run to
/// run: the sign that makes the first term positive is ours.
Operand inner_sum(const ex& sum, const SymbolTable& symbols) {
  std::vector<Operand> terms = sorted_terms(sum, symbols);
  const bool negative = terms.front().negative;
  if (negative) {
    for (Operand& term : terms) term.negative = !term.negative;
  }
  return make_operand(negative, sum_of(std::move(terms)), symbols);
}

/// One term or factor with its sign outside.
Operand signed_form(const ex& expression, const SymbolTable& symbols) {
  if (is_number(expression)) {
    const bool negative = number_sign(expression) < 0;
    return make_operand(negative, number_form(negative ? ex(-expression) : expression), symbols);
  }
  if (GiNaC::is_a<GiNaC::symbol>(expression)) {
    Form form;
    form.kind = Form::Kind::kSymbol;
    form.leaf = expression;
    return make_operand(false, std::move(form), symbols);
  }
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    return inner_sum(expression, symbols);
  }
  if (GiNaC::is_a<GiNaC::mul>(expression) || GiNaC::is_a<GiNaC::power>(expression)) {
    return product_form(expression, symbols);
  }
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::function>(expression), "unexpected kind of expression");
  Form form;
  form.kind = Form::Kind::kCall;
  form.call = call_name(expression);
  DYNGEN_ASSERT(!form.call.empty(), "an unknown function");
  if (form.call == "sign") {  // GiNaC may hold sign(a - b) c as -sign(b - a) c: the sign is ours
    Operand argument = inner_sum(expression.op(0), symbols);
    form.parts.push_back(std::move(argument.form));
    return make_operand(argument.negative, std::move(form), symbols);
  }
  for (std::size_t i = 0; i < expression.nops(); ++i) {
    form.parts.push_back(sum_form(expression.op(i), symbols));
  }
  return make_operand(false, std::move(form), symbols);
}

}  // namespace

Form canonical_form(const ex& expression, const SymbolTable& symbols) {
  return sum_form(expression, symbols);
}

std::string join_operands(const Form& form, const std::function<std::string(const Form&)>& spell) {
  std::string text;
  const bool sum = form.kind == Form::Kind::kSum;
  for (std::size_t i = 0; i < form.parts.size(); ++i) {
    const Form& part = form.parts[i];
    if (sum) {
      if (i > 0) {
        text += form.negative[i] ? " - " : " + ";
      } else if (form.negative[i]) {
        text += "-";
      }
    } else if (i > 0) {
      text += form.kind == Form::Kind::kQuotient ? " / " : " * ";
    }
    const bool divisor = form.kind == Form::Kind::kQuotient && i > 0;
    const bool brackets =
        part.kind == Form::Kind::kSum || (divisor && part.kind == Form::Kind::kProduct);
    text += brackets ? "(" + spell(part) + ")" : spell(part);
  }
  return text;
}

OperationCount& OperationCount::operator+=(const OperationCount& other) {
  multiplications += other.multiplications;
  additions += other.additions;
  sin_cos_pairs += other.sin_cos_pairs;
  signs += other.signs;
  calls += other.calls;
  divisions += other.divisions;
  return *this;
}

OperationCount count_operations(const Form& form) {
  OperationCount count;
  for (const Form& part : form.parts) count += count_operations(part);
  const int operands = static_cast<int>(form.parts.size());
  if (form.kind == Form::Kind::kSum) count.additions += operands - 1;
  if (form.kind == Form::Kind::kProduct) count.multiplications += operands - 1;
  if (form.kind == Form::Kind::kQuotient) ++count.divisions;
  if (form.kind == Form::Kind::kCall) {
    const bool trigonometric = form.call == "sin" || form.call == "cos";  // pairs of statements
    if (form.call == "sign") {
      ++count.signs;
    } else if (!trigonometric) {
      ++count.calls;
    }
  }
  return count;
}

}  // namespace dyngen
