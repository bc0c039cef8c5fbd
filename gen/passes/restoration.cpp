// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/restoration.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dyngen {
namespace {

constexpr std::size_t kMostRestored = 64;

class Restoration {
 public:
  Restoration(Network& network, const Network& source)
      : network_(network), source_(source), readers_(find_readers(network)) {}

  void run() {
    std::vector<int> order;
    for (int id = 0; id < source_.size(); ++id) {
      if (source_.node(id).place >= 0 && !network_.node(id).alive) order.push_back(id);
    }
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return source_.node(a).place < source_.node(b).place; });
    for (const int id : order) restore(id);
  }

 private:
  /// A sum of the source in the nodes that are left; none if it would have to be multiplied out.
  std::optional<std::vector<Term>> translated(int id) {
    std::vector<Term> result;
    for (const Term& term : source_.node(id).terms) {
      std::vector<Term> parts = {{term.negative, {}}};
      for (const int factor : term.factors) {
        std::vector<Term> value;
        if (network_.node(factor).alive) {
          const bool negated = network_.node(factor).negated != source_.node(factor).negated;
          value = {{negated, {factor}}};
        } else {
          const std::optional<std::vector<Term>> own = translated(factor);
          if (!own) return {};
          value = *own;
        }
        if (parts.size() > 1 && value.size() > 1) return {};
        std::vector<Term> next;
        for (const Term& part : parts) {
          for (const Term& own : value) next.push_back(product(part, own));
        }
        parts = std::move(next);
      }
      result.insert(result.end(), parts.begin(), parts.end());
      if (result.size() > kMostRestored) return {};
    }
    return normalised(network_, std::move(result));
  }

  void restore(int id) {
    const std::optional<std::vector<Term>> terms = translated(id);
    if (!terms || terms->size() < 2) return;
    const Term& first = (*terms)[0];
    if (first.factors.empty()) return;
    const int some = first.factors[0];
    if (static_cast<std::size_t>(some) >= readers_.size()) return;
    const std::vector<int> readers = readers_[static_cast<std::size_t>(some)];
    for (const int reader : readers) {
      if (!network_.node(reader).alive || !take_out(id, reader, *terms)) continue;
      return;
    }
  }

  /// Takes the terms out of a longer sum that has them all, with one sign.
  bool take_out(int id, int reader, const std::vector<Term>& terms) {
    std::vector<Term> rest = network_.node(reader).terms;
    if (rest.size() <= terms.size()) return false;
    std::optional<bool> negative;
    for (const Term& term : terms) {
      const auto it = std::find_if(rest.begin(), rest.end(), [&](const Term& candidate) {
        return candidate.factors == term.factors;
      });
      if (it == rest.end()) return false;
      const bool sign = it->negative != term.negative;
      if (negative && *negative != sign) return false;
      negative = sign;
      rest.erase(it);
    }
    Node& node = network_.node(id);
    const Node& old = source_.node(id);
    node.kind = Node::Kind::kSum;
    node.alive = true;
    node.name = old.name;
    node.place = old.place;
    node.section = old.section;
    node.negated = old.negated;
    node.terms = terms;
    rest.push_back({*negative, {id}});
    network_.node(reader).terms = normalised(network_, std::move(rest));
    for (const Term& term : terms) {
      for (const int factor : term.factors) {
        readers_[static_cast<std::size_t>(factor)].push_back(id);
      }
    }
    readers_[static_cast<std::size_t>(id)] = {reader};
    return true;
  }

  Network& network_;
  const Network& source_;
  Readers readers_;
};

}  // namespace

void restore_statements(Network& network, const Network& source) {
  Restoration(network, source).run();
}

}  // namespace dyngen
