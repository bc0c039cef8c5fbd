// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/simplify.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

namespace dyngen {
namespace {

constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

std::size_t at(int id) { return static_cast<std::size_t>(id); }

bool is_copy(const Node& node) {
  return node.terms.size() == 1 && node.terms[0].factors.size() == 1;
}

/// Zero, one or minus one.
bool is_number(const Node& node) {
  return node.terms.empty() || (node.terms.size() == 1 && node.terms[0].factors.empty());
}

class Simplification {
 public:
  explicit Simplification(Network& network) : network_(network), readers_(find_readers(network)) {}

  void run() {
    bool changed = true;
    while (changed) {
      changed = false;
      for (int id = 0; id < network_.size(); ++id) changed = visit(id) || changed;
      changed = share_equal() || changed;
      readers_ = find_readers(network_);
    }
  }

 private:
  /// @return whether something was changed
  bool visit(int id) {
    Node& node = network_.node(id);
    if (!node.alive) return false;
    if (node.kind == Node::Kind::kInverse && uses(id) == 0) {
      node.alive = false;
      return true;
    }
    if (node.kind != Node::Kind::kSum) return false;
    if (uses(id) == 0) {
      node.alive = false;
      node.terms.clear();
      return true;
    }
    if (is_number(node)) return read_by_term(id) && eliminate(network_, id, kAnyLength, readers_);
    if (is_copy(node)) return replace(id, node.terms[0].factors[0], node.terms[0].negative);
    if (node.terms.size() == 1 && node.terms[0].negative && !read_by_inverse(id)) {
      negate(id);
      return true;
    }
    if (uses(id) == 1 && stands_alone(id)) {
      return eliminate(network_, id, kAnyLength, readers_);
    }
    return false;
  }

  std::vector<int> distinct_readers(int id) const {
    std::vector<int> list = readers_[at(id)];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }

  int uses(int id) const {
    std::ptrdiff_t count = 0;
    for (const int reader : distinct_readers(id)) {
      const Node& node = network_.node(reader);
      if (!node.alive) continue;
      if (node.kind == Node::Kind::kInverse && node.of == id) ++count;
      for (const Term& term : node.terms) {
        count += std::count(term.factors.begin(), term.factors.end(), id);
      }
    }
    for (const NetworkOutput& output : network_.outputs) {
      if (output.node == id) ++count;
    }
    return static_cast<int>(count);
  }

  bool read_by_inverse(int id) const {
    return std::any_of(readers_[at(id)].begin(), readers_[at(id)].end(), [&](int reader) {
      const Node& node = network_.node(reader);
      return node.alive && node.kind == Node::Kind::kInverse && node.of == id;
    });
  }

  template <class Wanted>
  bool any_reading_term(int id, Wanted wanted) const {
    for (const int reader : readers_[at(id)]) {
      for (const Term& term : network_.node(reader).terms) {
        const bool found = std::binary_search(term.factors.begin(), term.factors.end(), id);
        if (found && wanted(term)) return true;
      }
    }
    return false;
  }

  bool read_by_term(int id) const {
    return any_reading_term(id, [](const Term&) { return true; });
  }

  /// Read by a term that takes it in without a multiplication more.
  bool stands_alone(int id) const {
    const bool is_product = network_.node(id).terms.size() == 1;
    return any_reading_term(
        id, [&](const Term& term) { return is_product || term.factors.size() == 1; });
  }

  /// Readers take another node, or its negation.
  bool replace(int id, int other, bool negative) {
    if (negative && read_by_inverse(id)) return false;
    for (const int reader : readers_[at(id)]) {
      Node& node = network_.node(reader);
      if (node.kind == Node::Kind::kInverse && node.of == id) {
        node.of = other;
        readers_[at(other)].push_back(reader);
      }
    }
    for (NetworkOutput& output : network_.outputs) {
      if (output.node != id) continue;
      output.node = other;
      output.negative = output.negative != negative;
    }
    network_.node(id).terms = {{negative, {other}}};
    return eliminate(network_, id, kAnyLength, readers_);
  }

  void negate(int id) {
    Node& own = network_.node(id);
    for (Term& term : own.terms) term.negative = !term.negative;
    own.negated = !own.negated;
    if (!own.name.empty()) own.name = negated_name(own.name);
    for (const int reader : distinct_readers(id)) {
      for (Term& term : network_.node(reader).terms) {
        if (std::count(term.factors.begin(), term.factors.end(), id) % 2 == 1) {
          term.negative = !term.negative;
        }
      }
    }
    for (NetworkOutput& output : network_.outputs) {
      if (output.node == id) output.negative = !output.negative;
    }
  }

  /// The terms with the first one positive.
  static std::vector<Term> unsigned_terms(const Node& node) {
    std::vector<Term> terms = node.terms;
    if (terms[0].negative) {
      for (Term& term : terms) term.negative = !term.negative;
    }
    return terms;
  }

  bool share_equal() {
    std::map<std::vector<Term>, int, bool (*)(const std::vector<Term>&, const std::vector<Term>&)>
        known(&before);
    std::map<int, int> inverses;
    bool changed = false;
    for (int id = 0; id < network_.size(); ++id) {
      const Node& node = network_.node(id);
      if (!node.alive) continue;
      if (node.kind == Node::Kind::kInverse) {
        const auto [it, added] = inverses.emplace(node.of, id);
        if (added) continue;
        Node& first = network_.node(it->second);
        if (first.name.empty()) {  // a statement of its own is divided once
          first.name = node.name;
          first.place = node.place;
          first.section = node.section;
        }
        changed = replace(id, it->second, false) || changed;
        continue;
      }
      if (node.kind != Node::Kind::kSum || is_number(node) || is_copy(node)) continue;
      const std::vector<Term> terms = unsigned_terms(node);
      const auto [it, added] = known.emplace(terms, id);
      if (added) continue;
      const int first = it->second;
      // the first may read what was replaced since
      if (!network_.node(first).alive || unsigned_terms(network_.node(first)) != terms) {
        it->second = id;
        continue;
      }
      const bool negative = node.terms[0].negative != network_.node(first).terms[0].negative;
      changed = replace(id, first, negative) || changed;
    }
    return changed;
  }

  static bool before(const std::vector<Term>& a, const std::vector<Term>& b) {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(), [](const Term& x, const Term& y) {
          return x.factors != y.factors ? x.factors < y.factors : x.negative < y.negative;
        });
  }

  /// What is stored is minus the quantity: Trace::assign() says so with an m.
  static std::string negated_name(const std::string& name) {
    const bool negated =
        name.size() > 1 && name[0] == 'm' && std::isupper(static_cast<unsigned char>(name[1])) != 0;
    return negated ? name.substr(1) : "m" + name;
  }

  Network& network_;
  Readers readers_;
};

}  // namespace

void simplify(Network& network) { Simplification(network).run(); }

}  // namespace dyngen
