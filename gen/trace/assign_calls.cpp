// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/assign_calls.h"

#include <utility>
#include <vector>

#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"
#include "gen/trace/form.h"

namespace dyngen {
namespace {

using GiNaC::ex;

class CallWriting {
 public:
  CallWriting(Trace& trace, const std::string& name) : trace_(trace), name_(name) {}

  /// Written twice: numbers of inner products stand beside those of outer ones after the first
  /// time. Each product has one number then, whose sign is not of GiNaC's choosing.
  ex write(const ex& expression) {
    const ex once = write(canonical_form(expression, trace_.symbols()));
    return write(canonical_form(once, trace_.symbols()));
  }

 private:
  ex write(const Form& form) {
    if (form.kind == Form::Kind::kNumber || form.kind == Form::Kind::kSymbol) return form.leaf;
    if (is_known(form)) return known_number(form);
    switch (form.kind) {
      case Form::Kind::kSum: {
        ex sum = 0;
        for (std::size_t i = 0; i < form.parts.size(); ++i) {
          const ex part = write(form.parts[i]);
          sum += form.negative[i] ? ex(-part) : part;
        }
        return sum;
      }
      case Form::Kind::kProduct:
        return product(form);
      case Form::Kind::kQuotient: {
        if (!is_known(form.parts[1])) return write(form.parts[0]) / write(form.parts[1]);
        Form one;
        one.leaf = 1;
        return write(form.parts[0]) * known_number(joined(form.kind, {one, form.parts[1]}));
      }
      case Form::Kind::kCall:
        return call(form);
      default:
        return form.leaf;
    }
  }

  static Form joined(Form::Kind kind, std::vector<Form> parts) {
    Form form;
    form.kind = kind;
    form.parts = std::move(parts);
    return form;
  }

  [[nodiscard]] bool is_input(const ex& value) const {
    return GiNaC::is_a<GiNaC::symbol>(value) &&
           trace_.symbols().info(value).kind == SymbolKind::kInput;
  }

  /// Only numbers in it, named or not.
  [[nodiscard]] bool is_known(const Form& form) const {
    if (form.kind == Form::Kind::kNumber) return true;
    if (form.kind == Form::Kind::kSymbol) {
      return trace_.symbols().info(form.leaf).kind == SymbolKind::kConstant;
    }
    for (const Form& part : form.parts) {
      if (!is_known(part)) return false;
    }
    return true;
  }

  /// All known factors are one number.
  ex product(const Form& form) {
    std::vector<Form> known;
    ex rest = 1;
    for (const Form& part : form.parts) {
      if (is_known(part)) {
        known.push_back(part);
      } else {
        rest *= write(part);
      }
    }
    if (known.empty()) return rest;
    return known_number(known.size() == 1 ? known[0] : joined(form.kind, known)) * rest;
  }

  ex call(const Form& form) {
    std::vector<ex> arguments;
    for (const Form& part : form.parts) arguments.push_back(argument(write(part)));
    if (form.call == "sign" && is_input(arguments[0])) return make_call("sign", arguments);
    const bool mirrored = arguments.size() == 1 && GiNaC::is_a<GiNaC::mul>(arguments[0]);
    if (mirrored && (form.call == "sin" || form.call == "cos")) {  // of -x
      const ex value = statement(make_call(form.call, {-arguments[0]}));
      return form.call == "sin" ? ex(-value) : value;
    }
    if (form.call == "pow" && is_known(form.parts[1])) {
      return power(arguments[0], number_of(form.parts[1]), arguments[1]);
    }
    return statement(make_call(form.call, arguments));
  }

  /// Whole and half exponents need no logarithm.
  ex power(const ex& base, const ex& number, const ex& exponent) {
    constexpr int kMostProduct = 8;
    const bool small = number <= kMostProduct && number >= -kMostProduct;
    if (small && number.info(GiNaC::info_flags::integer)) return GiNaC::pow(base, number);
    if (number.is_equal(ex(1) / 2)) return statement(real_sqrt(base));
    return statement(real_pow(base, exponent));
  }

  /// A symbol, its negation or a number.
  ex argument(const ex& value) {
    if (is_number(value)) return value;
    const ex settled = write(canonical_form(value, trace_.symbols()));
    return trace_.assign(name_ + "_x" + std::to_string(calls_ + 1), settled);
  }

  ex statement(const ex& value) {
    return trace_.assign(name_ + "_" + std::to_string(++calls_), value);
  }

  [[nodiscard]] ex number_of(const Form& form) const {
    switch (form.kind) {
      case Form::Kind::kNumber:
        return form.leaf;
      case Form::Kind::kSymbol:
        return trace_.symbols().info(form.leaf).value;
      case Form::Kind::kSum: {
        ex sum = 0;
        for (std::size_t i = 0; i < form.parts.size(); ++i) {
          const ex part = number_of(form.parts[i]);
          sum += form.negative[i] ? ex(-part) : part;
        }
        return sum;
      }
      case Form::Kind::kProduct: {
        ex product = 1;
        for (const Form& part : form.parts) product *= number_of(part);
        return product;
      }
      case Form::Kind::kQuotient:
        return number_of(form.parts[0]) / number_of(form.parts[1]);
      case Form::Kind::kCall: {
        std::vector<ex> arguments;
        for (const Form& part : form.parts) arguments.push_back(number_of(part));
        return make_call(form.call, arguments);
      }
    }
    return 0;
  }

  [[nodiscard]] std::string spell(const Form& form) const {
    if (form.kind == Form::Kind::kNumber) return shortest_decimal(form.leaf);
    if (form.kind == Form::Kind::kSymbol) return trace_.symbols().info(form.leaf).name;
    if (form.kind != Form::Kind::kCall) {
      return join_operands(form, [this](const Form& part) { return spell(part); });
    }
    std::string text;
    for (const Form& part : form.parts) text += (text.empty() ? "" : ", ") + spell(part);
    return form.call + "(" + text + ")";
  }

  ex known_number(const Form& form) {
    const bool single = form.kind == Form::Kind::kSum && form.parts.size() == 1;
    if (single && !form.negative[0]) return known_number(form.parts[0]);
    if (form.kind == Form::Kind::kSymbol || form.kind == Form::Kind::kNumber) return form.leaf;
    const std::string formula = spell(form);
    for (const SymbolInfo& info : trace_.symbols().own()) {
      if (info.kind == SymbolKind::kConstant && info.comment == formula) return info.symbol;
    }
    const std::string name = name_ + "_K" + std::to_string(++numbers_);
    return trace_.constant(name, number_of(form), {}, formula);
  }

  Trace& trace_;
  const std::string& name_;
  int calls_ = 0, numbers_ = 0;
};

}  // namespace

ex assign_calls(Trace& trace, const std::string& name, const ex& expression) {
  CallWriting writing(trace, name);
  return writing.write(expression);
}

}  // namespace dyngen
