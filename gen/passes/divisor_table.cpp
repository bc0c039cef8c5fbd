// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/divisor_table.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "gen/symbols/index.h"

namespace dyngen {
namespace {

int products(const Term& term) { return std::max(static_cast<int>(term.factors.size()) - 1, 0); }

std::vector<Term> with_product(std::vector<Term> terms, const Divisor& divisor, int id,
                               bool negated) {
  const int x = divisor[0].factors[0], y = divisor[0].factors[1];
  for (Term& term : terms) {
    std::vector<int>& f = term.factors;
    while (true) {
      const auto first = std::find(f.begin(), f.end(), x);
      if (first == f.end()) break;
      const auto second = std::find(first + 1, f.end(), y);
      if (second == f.end()) break;
      f.erase(second);
      f.erase(std::find(f.begin(), f.end(), x));
      f.insert(std::upper_bound(f.begin(), f.end(), id), id);
      term.negative = term.negative != negated;
    }
  }
  return terms;
}

std::vector<Term> with_sum(const std::vector<Term>& terms, const Divisor& divisor, int id,
                           bool negated) {
  std::vector<bool> used(terms.size(), false);
  std::vector<Term> result;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    for (std::size_t j = i + 1; j < terms.size() && !used[i]; ++j) {
      if (used[j]) continue;
      const DividedPair pair = divide(terms[i], terms[j]);
      if (pair.divisor != divisor) continue;
      used[i] = used[j] = true;
      result.push_back(product(pair.cofactor, {negated, {id}}));
    }
    if (!used[i]) result.push_back(terms[i]);
  }
  return result;
}

}  // namespace

DividedPair divide(const Term& first, const Term& second) {
  DividedPair pair;
  pair.divisor.resize(2);
  Term& a = pair.divisor[0];
  Term& b = pair.divisor[1];
  auto x = first.factors.begin();
  auto y = second.factors.begin();
  while (x != first.factors.end() || y != second.factors.end()) {
    if (y == second.factors.end() || (x != first.factors.end() && *x < *y)) {
      a.factors.push_back(*x++);
    } else if (x == first.factors.end() || *y < *x) {
      b.factors.push_back(*y++);
    } else {
      pair.cofactor.factors.push_back(*x++);
      ++y;
    }
  }
  a.negative = first.negative;
  b.negative = second.negative;
  if (b.factors < a.factors) std::swap(a, b);
  pair.cofactor.negative = a.negative;
  b.negative = b.negative != a.negative;
  a.negative = false;
  return pair;
}

bool is_divisor(const std::vector<Term>& terms, const Divisor& divisor) {
  if (terms.size() != divisor.size()) return false;
  const bool negative = terms[0].negative;
  for (std::size_t i = 0; i < divisor.size(); ++i) {
    if (terms[i].factors != divisor[i].factors ||
        terms[i].negative != (divisor[i].negative != negative)) {
      return false;
    }
  }
  return true;
}

std::vector<Term> divided(const std::vector<Term>& terms, const Divisor& divisor, int node,
                          bool negated) {
  return divisor.size() == 1 ? with_product(terms, divisor, node, negated)
                             : with_sum(terms, divisor, node, negated);
}

std::size_t DivisorTable::KeyHash::operator()(const Key& key) const {
  std::uint64_t hash = 0x9e3779b97f4a7c15U;
  for (const int part : key.parts) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0xff51afd7ed558ccdU;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

int DivisorTable::find(Divisor divisor) {
  Key key;
  key.parts.push_back(divisor.size() == 1 ? 0 : divisor[1].negative ? 1 : 2);
  key.parts.push_back(static_cast<int>(divisor[0].factors.size()));
  for (const Term& term : divisor) {
    key.parts.insert(key.parts.end(), term.factors.begin(), term.factors.end());
  }
  const auto [it, added] = places_.emplace(std::move(key), static_cast<int>(entries_.size()));
  if (added) {
    Entry entry;
    entry.cost = operations(divisor);
    entry.divisor = std::move(divisor);
    entries_.push_back(std::move(entry));
  }
  return it->second;
}

DivisorTable::Offers DivisorTable::offers(const std::vector<Term>& terms) {
  Offers result;
  std::vector<std::pair<int, int>> powers;
  for (const Term& term : terms) {
    powers.clear();
    for (const int factor : term.factors) {
      if (powers.empty() || powers.back().first != factor) powers.emplace_back(factor, 0);
      ++powers.back().second;
    }
    for (std::size_t i = 0; i < powers.size(); ++i) {
      const auto [x, x_power] = powers[i];
      if (x_power > 1) result.push_back({find({{false, {x, x}}}), x_power / 2});
      for (std::size_t j = i + 1; j < powers.size(); ++j) {
        const auto [y, y_power] = powers[j];
        result.push_back({find({{false, {x, y}}}), std::min(x_power, y_power)});
      }
    }
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    for (std::size_t j = i + 1; j < terms.size(); ++j) {
      DividedPair pair = divide(terms[i], terms[j]);
      const int saved = 1 + products(terms[i]) + products(terms[j]) -
                        static_cast<int>(pair.cofactor.factors.size());
      result.push_back({find(std::move(pair.divisor)), saved});
    }
  }
  work_ += static_cast<std::int64_t>(result.size());
  std::sort(result.begin(), result.end(),
            [](const Offer& a, const Offer& b) { return a.divisor < b.divisor; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (kept > 0 && result[kept - 1].divisor == result[i].divisor) {
      result[kept - 1].saved += result[i].saved;
    } else {
      result[kept++] = result[i];
    }
  }
  result.resize(kept);
  return result;
}

void DivisorTable::add(int node, const Offers& offers) {
  for (const Offer& offer : offers) {
    entries_[at(offer.divisor)].nodes.push_back(node);
    change(offer.divisor, offer.saved);
  }
}

void DivisorTable::remove(int node, const Offers& offers) {
  for (const Offer& offer : offers) {
    std::vector<int>& nodes = entries_[at(offer.divisor)].nodes;
    const auto it = std::find(nodes.begin(), nodes.end(), node);
    *it = nodes.back();
    nodes.pop_back();
    change(offer.divisor, -offer.saved);
  }
}

void DivisorTable::change(int place, int difference) {
  Entry& entry = entries_[at(place)];
  if (entry.total > entry.cost) queue_.erase({entry.cost - entry.total, place});
  entry.total += difference;
  if (entry.total > entry.cost) queue_.insert({entry.cost - entry.total, place});
}

int DivisorTable::best(std::uint64_t pick) const {
  if (queue_.empty()) return -1;
  constexpr std::uint64_t kChoices = 8;
  auto it = queue_.begin();
  const int gain = it->first;
  for (std::uint64_t left = pick % kChoices; left > 0; --left) {
    const auto next = std::next(it);
    if (next == queue_.end() || next->first != gain) break;
    it = next;
  }
  return it->second;
}

const Divisor& DivisorTable::divisor(int place) const { return entries_[at(place)].divisor; }

std::vector<int> DivisorTable::nodes(int place) const {
  std::vector<int> result = entries_[at(place)].nodes;
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace dyngen
