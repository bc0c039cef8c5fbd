// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {

using GiNaC::ex;

namespace {

constexpr std::array<int, DraftValue::kMostFactors> kNoFactors = {-1, -1, -1, -1};

std::size_t hash(const DraftValue& value) {
  std::size_t result = 0;
  const auto mix = [&](int number) {
    result = (result ^ static_cast<std::size_t>(number + 7)) * 0x9E3779B97F4A7C15U;
    result ^= result >> 29U;
  };
  for (const DraftValue::Term& term : value.terms()) {
    mix(term.coefficient);
    for (const int factor : term.factors) {
      if (factor < 0) break;
      mix(factor);
    }
  }
  return result;
}

}  // namespace

DraftValue::DraftValue(int number) {
  if (number != 0) terms_[size_++] = {number, kNoFactors};
}

DraftValue DraftValue::symbol(int symbol) {
  DraftValue value = 1;
  value.terms_[0].factors[0] = symbol;
  return value;
}

bool DraftValue::is_plain() const {
  if (size_ == 0) return true;
  if (size_ > 1) return false;
  const Term& term = terms_.front();
  return term.factors[0] < 0 || (std::abs(term.coefficient) == 1 && term.factors[1] < 0);
}

void DraftValue::add(const Term& term) {
  std::size_t at = 0;
  while (at < size_ && terms_[at].factors < term.factors) ++at;
  if (at < size_ && terms_[at].factors == term.factors) {
    terms_[at].coefficient += term.coefficient;
    if (terms_[at].coefficient != 0) return;
    std::copy(terms_.begin() + static_cast<std::ptrdiff_t>(at) + 1,
              terms_.begin() + static_cast<std::ptrdiff_t>(size_),
              terms_.begin() + static_cast<std::ptrdiff_t>(at));
    --size_;
    return;
  }
  DYNGEN_ASSERT(size_ < kMostTerms, "a draft's sums have few terms");
  std::copy_backward(terms_.begin() + static_cast<std::ptrdiff_t>(at),
                     terms_.begin() + static_cast<std::ptrdiff_t>(size_),
                     terms_.begin() + static_cast<std::ptrdiff_t>(size_) + 1);
  terms_[at] = term;
  ++size_;
}

DraftValue DraftValue::operator-() const {
  DraftValue result = *this;
  for (std::size_t i = 0; i < size_; ++i) {
    result.terms_[i].coefficient = -result.terms_[i].coefficient;
  }
  return result;
}

DraftValue operator+(const DraftValue& a, const DraftValue& b) {
  DraftValue result = a;
  for (const DraftValue::Term& term : b.terms()) result.add(term);
  return result;
}

DraftValue operator*(const DraftValue& a, const DraftValue& b) {
  DraftValue result;
  for (const DraftValue::Term& x : a.terms()) {
    for (const DraftValue::Term& y : b.terms()) {
      DraftValue::Term product{x.coefficient * y.coefficient, x.factors};
      auto& factors = product.factors;
      for (const int factor : y.factors) {
        if (factor < 0) break;
        DYNGEN_ASSERT(factors.back() < 0, "a draft's products have few factors");
        std::size_t at = factors.size() - 1;
        for (; at > 0 && (factors[at - 1] < 0 || factors[at - 1] > factor); --at) {
          factors[at] = factors[at - 1];
        }
        factors[at] = factor;
      }
      result.add(product);
    }
  }
  return result;
}

DraftValue DraftLeaves::add(const std::string& name, const ex& value) {
  if (is_number(value)) {
    for (const int number : {0, 1, -1}) {
      if (value.is_equal(number)) return number;
    }
  }
  const bool negative = GiNaC::is_a<GiNaC::mul>(value) && value.nops() == 2 &&
                        GiNaC::is_a<GiNaC::symbol>(value.op(0)) && value.op(1).is_equal(-1);
  if (negative) return -add(name, -value);
  if (!GiNaC::is_a<GiNaC::symbol>(value)) return add(name, trace_.assign(name, value));
  for (std::size_t i = 0; i < symbols_.size(); ++i) {
    if (symbols_[i].is_equal(value)) return DraftValue::symbol(static_cast<int>(i));
  }
  symbols_.push_back(value);
  constant_.push_back(trace_.symbols().info(value).kind == SymbolKind::kConstant);
  return DraftValue::symbol(static_cast<int>(symbols_.size()) - 1);
}

std::string DraftName::text() const {
  std::string name = stem;
  if (component > 0) name += std::to_string(component);
  name += fmt::format("_{}", first);
  if (second > 0) name += fmt::format("_{}", second);
  return name;
}

Draft::Draft(const DraftLeaves& leaves) : leaves_(leaves) {
  constexpr std::size_t kRoom = 1024;
  constant_.reserve(leaves.size() + kRoom / 2);
  statements_.reserve(kRoom / 2);
  index_.assign(kRoom, -1);
  for (std::size_t i = 0; i < leaves.size(); ++i) constant_.push_back(leaves.constant(i));
}

void Draft::section(const char* before, int number, const char* after) {
  sections_.push_back({before, number, after});
}

std::size_t Draft::find(const DraftValue& value) const {
  std::size_t at = hash(value) % index_.size();
  while (index_[at] >= 0 && !(statements_[static_cast<std::size_t>(index_[at])].value == value)) {
    at = (at + 1) % index_.size();
  }
  return at;
}

/// Keeps half of the table free.
void Draft::grow_index() {
  if (2 * statements_.size() < index_.size()) return;
  index_.assign(2 * index_.size(), -1);
  for (std::size_t i = 0; i < statements_.size(); ++i) {
    index_[find(statements_[i].value)] = static_cast<int>(i);
  }
}

DraftValue Draft::assign(const DraftName& name, const DraftValue& value) {
  if (value.is_plain()) return value;
  const bool negative = value.terms().front().coefficient < 0;
  const DraftValue positive = negative ? -value : value;
  grow_index();
  int& place = index_[find(positive)];
  if (place < 0) {
    place = static_cast<int>(statements_.size());
    bool constant = true;
    for (const DraftValue::Term& term : positive.terms()) {
      for (const int factor : term.factors) {
        if (factor >= 0 && !constant_[static_cast<std::size_t>(factor)]) constant = false;
      }
    }
    const int symbol = static_cast<int>(constant_.size());
    constant_.push_back(constant);
    statements_.push_back({name, positive, symbol, static_cast<int>(sections_.size()) - 1});
  }
  const DraftValue symbol = DraftValue::symbol(statements_[static_cast<std::size_t>(place)].symbol);
  return negative ? -symbol : symbol;
}

std::size_t Draft::want(const DraftValue& value) {
  wanted_.push_back(value);
  return wanted_.size() - 1;
}

int Draft::operations(const DraftValue& value) const {
  int result = static_cast<int>(value.terms().size()) - 1;
  for (const DraftValue::Term& term : value.terms()) {
    int factors = 0;
    bool constant = std::abs(term.coefficient) != 1;  // known factors are one number in the end
    for (const int factor : term.factors) {
      if (factor < 0) break;
      if (constant_[static_cast<std::size_t>(factor)]) {
        constant = true;
      } else {
        ++factors;
      }
    }
    result += std::max(0, factors - (constant ? 0 : 1));
  }
  return result;
}

std::vector<bool> Draft::needed() const {
  std::vector<bool> result(constant_.size(), false);
  const auto mark = [&](const DraftValue& value) {
    for (const DraftValue::Term& term : value.terms()) {
      for (const int factor : term.factors) {
        if (factor >= 0) result[static_cast<std::size_t>(factor)] = true;
      }
    }
  };
  for (const DraftValue& value : wanted_) mark(value);
  for (auto it = statements_.rbegin(); it != statements_.rend(); ++it) {
    if (result[static_cast<std::size_t>(it->symbol)]) mark(it->value);
  }
  return result;
}

int Draft::count() const {
  const std::vector<bool> live = needed();
  int result = 0;
  for (const Statement& statement : statements_) {
    const auto symbol = static_cast<std::size_t>(statement.symbol);
    if (live[symbol] && !constant_[symbol]) result += operations(statement.value);
  }
  for (const DraftValue& value : wanted_) result += std::max(0, operations(value));
  return result;
}

std::vector<ex> Draft::write() const {
  Trace& trace = leaves_.trace();
  const std::vector<bool> live = needed();
  std::vector<ex> symbols(constant_.size(), 0);
  for (std::size_t i = 0; i < leaves_.size(); ++i) symbols[i] = leaves_.symbol(i);
  const auto expression = [&](const DraftValue& value) {
    ex sum = 0;
    for (const DraftValue::Term& term : value.terms()) {
      ex product = term.coefficient;
      for (const int factor : term.factors) {
        if (factor >= 0) product *= symbols[static_cast<std::size_t>(factor)];
      }
      sum += product;
    }
    return sum;
  };
  int section = -1;
  for (const Statement& statement : statements_) {
    const auto symbol = static_cast<std::size_t>(statement.symbol);
    if (!live[symbol]) continue;
    if (statement.section != section) {
      section = statement.section;
      const Section& title = sections_[static_cast<std::size_t>(section)];
      trace.section(fmt::format("{}{}{}", title.before, title.number, title.after));
    }
    symbols[symbol] = trace.assign(statement.name.text(), expression(statement.value));
  }
  std::vector<ex> result;
  for (const DraftValue& value : wanted_) result.push_back(expression(value));
  return result;
}

}  // namespace dyngen
