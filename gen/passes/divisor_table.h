// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gen/passes/network.h"

namespace dyngen {

/// A sum of two terms without a common factor, the first one positive; or a product of two nodes
/// (then one term).
using Divisor = std::vector<Term>;

/// Two terms of a sum as cofactor * divisor.
struct DividedPair {
  Divisor divisor;
  Term cofactor;
};
DividedPair divide(const Term& a, const Term& b);

/// True if a sum is a divisor or its negation.
bool is_divisor(const std::vector<Term>& terms, const Divisor& divisor);

/// A sum with a divisor's node in place of the divisor.
/// @param negated  the node is minus the divisor
std::vector<Term> divided(const std::vector<Term>& terms, const Divisor& divisor, int node,
                          bool negated);

/// Every divisor of every sum, and what naming it would save: kept up to date sum by sum.
///
/// Source: two-term divisors and two-literal products as in Rajski and Vasudevamurthy, "The
/// testability-preserving concurrent decomposition and factorization of Boolean expressions" (IEEE
/// Trans. CAD, 1992), after the kernels of Brayton and McMullen 1982; for polynomials Hosangadi,
/// Fallah and Kastner 2006.
class DivisorTable {
 public:
  /// A divisor that occurs in a sum, and what it would save there if it were known.
  struct Offer {
    int divisor = 0;
    int saved = 0;
  };
  using Offers = std::vector<Offer>;

  /// What the terms offer, each divisor once.
  Offers offers(const std::vector<Term>& terms);

  void add(int node, const Offers& offers);
  void remove(int node, const Offers& offers);

  /// A divisor that saves most, more than nothing; -1 if there is none.
  /// @param pick  of several that save as much, which
  [[nodiscard]] int best(std::uint64_t pick) const;
  [[nodiscard]] const Divisor& divisor(int place) const;
  /// Divisors looked at until now: the measure of the time that was spent.
  [[nodiscard]] std::int64_t work() const { return work_; }
  /// The sums that it occurs in.
  [[nodiscard]] std::vector<int> nodes(int place) const;

 private:
  struct Key {
    std::vector<int> parts;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  struct Entry {
    Divisor divisor;
    int cost = 0;   // of naming it
    int total = 0;  // that it saves where it occurs
    std::vector<int> nodes;
  };

  int find(Divisor divisor);
  void change(int place, int difference);

  std::unordered_map<Key, int, KeyHash> places_;
  std::vector<Entry> entries_;
  std::int64_t work_ = 0;
  std::set<std::pair<int, int>> queue_;  // cost - total < 0, place
};

}  // namespace dyngen
