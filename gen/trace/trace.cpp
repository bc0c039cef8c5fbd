// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/trace.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// True for x and -x.
bool is_signed_symbol(const ex& value) {
  if (GiNaC::is_a<GiNaC::symbol>(value)) return true;
  return GiNaC::is_a<GiNaC::mul>(value) && value.nops() == 2 &&
         GiNaC::is_a<GiNaC::symbol>(value.op(0)) && value.op(1).is_equal(-1);
}

void collect_symbols(const ex& value, std::set<std::string>& names) {
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it)) names.insert(GiNaC::ex_to<GiNaC::symbol>(*it).get_name());
  }
}

}  // namespace

std::string output_name(const std::string& array, int index) {
  const std::size_t member = array.rfind('>');
  return array.substr(member == std::string::npos ? 0 : member + 1) + "_" +
         std::to_string(index + 1);
}

void Trace::section(std::string title) { sections_.push_back(std::move(title)); }

bool Trace::is_constant(const ex& value) const {
  if (GiNaC::is_a<GiNaC::symbol>(value)) {
    return symbols_.info(value).kind == SymbolKind::kConstant;
  }
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it) && symbols_.info(*it).kind != SymbolKind::kConstant) {
      return false;
    }
  }
  return true;
}

ex Trace::constant_value(const ex& value) const {
  GiNaC::exmap values;
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it)) values[*it] = symbols_.info(*it).value;
  }
  return value.subs(values, GiNaC::subs_options::no_pattern);
}

ex Trace::constant(const std::string& name, const ex& value, const std::string& unit,
                   const std::string& comment) {
  return add_constant(symbols_, name, value, unit, comment);
}

/// Several constants in one product become one: their product is known now.
Trace::FoldedTerm Trace::split_term(const ex& term) const {
  FoldedTerm folded{1, {}, 1, term};
  if (!GiNaC::is_a<GiNaC::mul>(term)) return folded;
  std::vector<std::pair<int, ex>> constants;  // by place, so that the name does not depend on GiNaC
  ex number = 1;
  ex rest = 1;
  for (std::size_t i = 0; i < term.nops(); ++i) {
    const ex factor = term.op(i);
    if (is_number(factor)) {
      number *= factor;
    } else if (GiNaC::is_a<GiNaC::symbol>(factor) && is_constant(factor)) {
      constants.emplace_back(symbols_.place(factor), factor);
    } else {
      rest *= factor;
    }
  }
  const bool plain_number = number.is_equal(1) || number.is_equal(-1);
  if (constants.empty() || (constants.size() == 1 && plain_number)) return folded;
  std::sort(constants.begin(), constants.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [place, symbol] : constants) {
    folded.name += (folded.name.empty() ? "" : "_") + symbols_.info(symbol).name;
    folded.value *= symbols_.info(symbol).value;
  }
  if (plain_number) {
    folded.sign = number;
  } else {
    folded.name = "K_" + folded.name;
    folded.value *= number;
  }
  folded.rest = rest;
  return folded;
}

ex Trace::fold_constants(const ex& value) {
  std::vector<FoldedTerm> terms;
  if (GiNaC::is_a<GiNaC::add>(value)) {
    for (std::size_t i = 0; i < value.nops(); ++i) terms.push_back(split_term(value.op(i)));
  } else {
    terms.push_back(split_term(value));
  }
  // new constants get their places in the order of their names: GiNaC's order of terms is none
  std::sort(terms.begin(), terms.end(), [](const FoldedTerm& a, const FoldedTerm& b) {
    return a.name != b.name ? a.name < b.name : to_double(a.value) < to_double(b.value);
  });
  ex sum = 0;
  for (const FoldedTerm& term : terms) {
    sum += term.name.empty() ? term.rest : term.sign * constant(term.name, term.value) * term.rest;
  }
  return sum;
}

ex Trace::assign(const std::string& name, const ex& value) {
  if (is_number(value)) {
    return constant(name, value);
  }
  if (is_signed_symbol(value)) return value;
  if (is_constant(value)) return constant(name, constant_value(value));
  ex folded = fold_constants(value);
  if (is_signed_symbol(folded)) return folded;

  // a - b and b - a are one statement: the one whose form begins with the smaller first term
  ex positive = folded;
  bool negated = false;
  const Form form = canonical_form(folded, symbols_);
  const auto negatives = std::count(form.negative.begin(), form.negative.end(), true);
  if (2 * static_cast<std::size_t>(negatives) > form.negative.size()) {
    positive = -folded;
    negated = true;
  }
  if (const auto it = assigned_.find(positive); it != assigned_.end()) {
    return negated ? ex(-it->second) : it->second;
  }
  if (const auto it = assigned_.find(-positive); it != assigned_.end()) {
    return negated ? it->second : ex(-it->second);
  }
  SymbolInfo info;
  info.name = negated ? "m" + name : name;  // what is stored is minus the quantity: say so
  const GiNaC::symbol target = symbols_.add(std::move(info));
  assignments_.push_back({target, positive, static_cast<int>(sections_.size()) - 1});
  assigned_.emplace(positive, target);
  return negated ? ex(-target) : ex(target);
}

Trace::SinCos Trace::sin_cos(const std::string& suffix, const ex& angle) {
  ex moving = 0;
  ex offset = 0;
  const auto add_term = [&](const ex& term) { (is_number(term) ? offset : moving) += term; };
  if (GiNaC::is_a<GiNaC::add>(angle)) {
    for (std::size_t i = 0; i < angle.nops(); ++i) add_term(angle.op(i));
  } else {
    add_term(angle);
  }
  if (moving.is_zero()) {
    return {constant("S" + suffix, exact_sin(offset)), constant("C" + suffix, exact_cos(offset))};
  }
  const Form form = canonical_form(moving, symbols_);
  if (form.negative[0]) {  // all terms are negative: sin(-x) = -sin(x)
    const SinCos mirrored = sin_cos(suffix, -angle);
    return {-mirrored.sin, mirrored.cos};
  }
  // whole right angles exchange sin and cos and cost nothing
  const ex quarters = offset * 2 / GiNaC::Pi;
  if (quarters.info(GiNaC::info_flags::integer) && !offset.is_zero()) {
    SinCos plain = sin_cos(suffix, moving);
    switch (GiNaC::mod(GiNaC::ex_to<GiNaC::numeric>(quarters), 4).to_int()) {
      case 1:
        return {plain.cos, -plain.sin};
      case 2:
        return {-plain.sin, -plain.cos};
      case 3:
        return {-plain.cos, plain.sin};
      default:
        return plain;
    }
  }
  const ex argument = assign("Q" + suffix, moving + constant("TH" + suffix, offset, "rad"));
  if (!GiNaC::is_a<GiNaC::symbol>(argument)) {  // stored with its sign changed
    return {-assign("S" + suffix, GiNaC::sin(-argument)),
            assign("C" + suffix, GiNaC::cos(-argument))};
  }
  return {assign("S" + suffix, GiNaC::sin(argument)), assign("C" + suffix, GiNaC::cos(argument))};
}

/// Outputs are written last, from locals: a caller may pass one array as input and output.
void Trace::output(const std::string& array, int index, const ex& value) {
  const std::string name = output_name(array, index);
  ex result = assign(name, value);
  const ex symbol = GiNaC::is_a<GiNaC::mul>(result) ? result.op(0) : result;
  if (GiNaC::is_a<GiNaC::symbol>(symbol)) {
    const SymbolKind kind = symbols_.info(symbol).kind;
    if (kind == SymbolKind::kInput || kind == SymbolKind::kParameter) {
      SymbolInfo info;
      info.name = name;
      const GiNaC::symbol copy = symbols_.add(std::move(info));
      assignments_.push_back({copy, result, static_cast<int>(sections_.size()) - 1});
      result = copy;
    }
  }
  outputs_.push_back({array, index, result});
}

void Trace::rename_output(const std::string& from, const std::string& to) {
  for (Output& output : outputs_) {
    if (output.array == from) output.array = to;
  }
}

Trace Trace::without_statements() const {
  Trace empty(symbols_.parent());
  empty.sections_ = sections_;
  return empty;
}

GiNaC::symbol Trace::append(const std::string& name, const ex& value, int section) {
  SymbolInfo info;
  info.name = name;
  GiNaC::symbol target = symbols_.add(std::move(info));
  assignments_.push_back({target, value, section});
  return target;
}

void Trace::rearrange(const std::vector<Position>& order) {
  DYNGEN_ASSERT(order.size() == assignments_.size(), "statements are lost");
  std::vector<Assignment> assignments;
  for (const Position& position : order) {
    assignments.push_back(assignments_[position.statement]);
    assignments.back().section = position.section;
  }
  assignments_ = std::move(assignments);
}

void Trace::drop_dead_code() {
  std::set<std::string> needed;
  for (const Output& output : outputs_) collect_symbols(output.value, needed);
  std::vector<Assignment> kept;
  for (auto it = assignments_.rbegin(); it != assignments_.rend(); ++it) {
    if (!needed.contains(it->target.get_name())) continue;
    collect_symbols(it->value, needed);
    kept.push_back(*it);
  }
  std::reverse(kept.begin(), kept.end());
  assignments_ = std::move(kept);
  // what is written later must not read a statement that is gone
  std::erase_if(assigned_, [&](const auto& entry) {
    return !needed.contains(GiNaC::ex_to<GiNaC::symbol>(entry.second).get_name());
  });
}

OperationCount Trace::count() const {
  OperationCount total;
  std::set<ex, GiNaC::ex_is_less> angles;
  for (const Assignment& assignment : assignments_) {
    const ex& value = assignment.value;
    const std::string call = call_name(value);
    const bool trigonometric = call == "sin" || call == "cos";
    if (trigonometric && angles.insert(value.op(0)).second) ++total.sin_cos_pairs;
    total += count_operations(canonical_form(value, symbols_));
  }
  for (const Output& output : outputs_) {
    total += count_operations(canonical_form(output.value, symbols_));
  }
  return total;
}

}  // namespace dyngen
