// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/extraction.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "gen/passes/simplify.h"

namespace dyngen {
namespace {

std::size_t at(int id) { return static_cast<std::size_t>(id); }

/// A sum of two terms without a common factor, the first one positive; or a product of two nodes
/// (then one term).
using Divisor = std::vector<Term>;

/// A divisor as numbers: the sign of the second term, the length of the first, the factors.
using Key = std::vector<int>;

Key key_of(const Divisor& divisor) {
  Key key;
  const bool sum = divisor.size() == 2;
  key.push_back(!sum ? 0 : divisor[1].negative ? 1 : 2);
  key.push_back(static_cast<int>(divisor[0].factors.size()));
  for (const Term& term : divisor) {
    key.insert(key.end(), term.factors.begin(), term.factors.end());
  }
  return key;
}

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15U;
    for (const int part : key) {
      hash = (hash ^ static_cast<std::uint64_t>(part)) * 0xff51afd7ed558ccdU;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Two terms of a sum as cofactor * divisor.
struct Pair {
  Divisor divisor;
  Term cofactor;
};

Pair divide(const Term& first, const Term& second) {
  Pair pair;
  Term a, b;
  std::set_intersection(first.factors.begin(), first.factors.end(), second.factors.begin(),
                        second.factors.end(), std::back_inserter(pair.cofactor.factors));
  const auto without = [&](const Term& term) {
    Term rest;
    std::set_difference(term.factors.begin(), term.factors.end(), pair.cofactor.factors.begin(),
                        pair.cofactor.factors.end(), std::back_inserter(rest.factors));
    return rest;
  };
  a = without(first);
  b = without(second);
  a.negative = first.negative;
  b.negative = second.negative;
  if (b.factors < a.factors) std::swap(a, b);
  pair.cofactor.negative = a.negative;
  b.negative = b.negative != a.negative;
  a.negative = false;
  pair.divisor = {std::move(a), std::move(b)};
  return pair;
}

class Extraction {
 public:
  Extraction(Network& network, std::uint64_t order) : network_(network), order_(order) {}

  void run() {
    for (int id = 0; id < network_.size(); ++id) scan(id);
    while (!queue_.empty() && std::get<0>(*queue_.begin()) < 0) {
      const int divisor = std::get<2>(*queue_.begin());
      if (!apply(divisor)) break;
    }
  }

 private:
  struct Entry {
    Divisor divisor;
    int cost = 0;
    std::map<int, int> savings;  // by node
    int total = 0;
    std::uint64_t rank = 0;
  };

  // ---- what a node offers

  template <class Visit>
  void each_offer(const Node& node, Visit visit) const {
    for (const Term& term : node.terms) {
      const std::vector<int>& f = term.factors;
      for (std::size_t i = 0; i < f.size(); ++i) {
        if (i > 0 && f[i] == f[i - 1]) continue;
        const auto power = [&](std::size_t k) {
          return static_cast<int>(std::count(f.begin(), f.end(), f[k]));
        };
        if (power(i) > 1) visit(Divisor{{false, {f[i], f[i]}}}, power(i) / 2);
        for (std::size_t j = i + 1; j < f.size(); ++j) {
          if (f[j] == f[j - 1] || f[j] == f[i]) continue;
          visit(Divisor{{false, {f[i], f[j]}}}, std::min(power(i), power(j)));
        }
      }
    }
    for (std::size_t i = 0; i < node.terms.size(); ++i) {
      for (std::size_t j = i + 1; j < node.terms.size(); ++j) {
        const Pair pair = divide(node.terms[i], node.terms[j]);
        visit(pair.divisor, saving(pair, node.terms[i], node.terms[j]));
      }
    }
  }

  static int products(const Term& term) {
    return std::max(static_cast<int>(term.factors.size()) - 1, 0);
  }

  static int saving(const Pair& pair, const Term& a, const Term& b) {
    return 1 + products(a) + products(b) - static_cast<int>(pair.cofactor.factors.size());
  }

  void scan(int id) {
    offers_.resize(network_.nodes.size());
    const Node& node = network_.node(id);
    if (!node.alive || node.kind != Node::Kind::kSum) return;
    std::vector<int>& own = offers_[at(id)];
    each_offer(node, [&](const Divisor& divisor, int saved) {
      const int entry = find(divisor);
      Entry& target = entries_[at(entry)];
      int& share = target.savings[id];
      if (share == 0) own.push_back(entry);
      share += saved;
      change(entry, saved);
    });
  }

  void forget(int id) {
    for (const int entry : offers_[at(id)]) {
      Entry& target = entries_[at(entry)];
      const auto it = target.savings.find(id);
      const int share = it->second;
      target.savings.erase(it);
      change(entry, -share);
    }
    offers_[at(id)].clear();
  }

  int find(const Divisor& divisor) {
    const auto [it, added] = places_.emplace(key_of(divisor), static_cast<int>(entries_.size()));
    if (added) {
      Entry entry;
      entry.divisor = divisor;
      entry.cost = operations(divisor);
      entry.rank = order_ == 0 ? 0 : KeyHash()(it->first) * (order_ | 1) ^ (order_ >> 7);
      entries_.push_back(std::move(entry));
    }
    return it->second;
  }

  void change(int place, int difference) {
    Entry& entry = entries_[at(place)];
    const auto queued = [&] { return std::tuple{entry.cost - entry.total, entry.rank, place}; };
    if (entry.total > entry.cost) queue_.erase(queued());
    entry.total += difference;
    if (entry.total > entry.cost) queue_.insert(queued());
  }

  // ---- naming a divisor

  /// @return whether the network changed
  bool apply(int place) {
    const Divisor divisor = entries_[at(place)].divisor;
    std::vector<int> readers;
    int known = -1;
    for (const auto& [id, saved] : entries_[at(place)].savings) {
      if (known < 0 && is_divisor(network_.node(id), divisor)) {
        known = id;
      } else {
        readers.push_back(id);
      }
    }
    if (readers.empty()) return false;
    bool negative = false;
    if (known < 0) {
      known = network_.add({.terms = divisor});
      network_.node(known).terms = divisor;
      scan(known);
    } else {
      negative = network_.node(known).terms[0].negative;
    }
    for (const int reader : readers) {
      forget(reader);
      std::vector<Term> terms = divisor.size() == 1
                                    ? with_product(network_.node(reader).terms, divisor, known)
                                    : with_sum(network_.node(reader).terms, divisor, known);
      if (negative) negate_reads(terms, known);
      terms = normalised(network_, std::move(terms));
      network_.node(reader).terms = std::move(terms);
      scan(reader);
    }
    return true;
  }

  static bool is_divisor(const Node& node, const Divisor& divisor) {
    if (node.terms.size() != divisor.size()) return false;
    const bool negative = node.terms[0].negative;
    for (std::size_t i = 0; i < divisor.size(); ++i) {
      if (node.terms[i].factors != divisor[i].factors ||
          node.terms[i].negative != (divisor[i].negative != negative)) {
        return false;
      }
    }
    return true;
  }

  static void negate_reads(std::vector<Term>& terms, int id) {
    for (Term& term : terms) {
      const auto power = std::count(term.factors.begin(), term.factors.end(), id);
      if (power % 2 == 1) term.negative = !term.negative;
    }
  }

  static std::vector<Term> with_product(std::vector<Term> terms, const Divisor& divisor, int id) {
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
      }
    }
    return terms;
  }

  static std::vector<Term> with_sum(const std::vector<Term>& terms, const Divisor& divisor,
                                    int id) {
    std::vector<bool> used(terms.size(), false);
    std::vector<Term> result;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      for (std::size_t j = i + 1; j < terms.size() && !used[i]; ++j) {
        if (used[j]) continue;
        const Pair pair = divide(terms[i], terms[j]);
        if (pair.divisor != divisor) continue;
        used[i] = used[j] = true;
        result.push_back(product(pair.cofactor, {false, {id}}));
      }
      if (!used[i]) result.push_back(terms[i]);
    }
    return result;
  }

  Network& network_;
  std::uint64_t order_;
  std::unordered_map<Key, int, KeyHash> places_;
  std::vector<Entry> entries_;
  std::vector<std::vector<int>> offers_;                 // of each node: entries
  std::set<std::tuple<int, std::uint64_t, int>> queue_;  // cost - total, rank, entry
};

}  // namespace

void extract_divisors(Network& network, std::uint64_t order) { Extraction(network, order).run(); }

}  // namespace dyngen
