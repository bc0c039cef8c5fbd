// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/fold.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "gen/passes/conversion.h"
#include "gen/passes/network.h"
#include "gen/passes/search.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

/// What is longer when multiplied out is not looked into.
constexpr std::size_t kMostFoldedTerms = 200;

/// A polynomial in the parameters, in nodes of the network of fold.
using Polynomial = std::vector<Term>;

struct PolynomialLess {
  bool operator()(const Polynomial& a, const Polynomial& b) const {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(), [](const Term& x, const Term& y) {
          return std::tie(x.factors, x.negative) < std::tie(y.factors, y.negative);
        });
  }
};

class Folding {
 public:
  explicit Folding(SymbolTable& inputs) : inputs_(inputs) {}

  Trace fold_function(const Trace& trace) {
    Network network = to_network(trace);
    values_.assign(network.nodes.size(), std::nullopt);
    const int size = network.size();  // operands stand before what reads them
    for (int id = 0; id < size; ++id) {
      values_[at(id)] = value_of(network, trace.symbols(), id);
      if (!values_[at(id)] && network.is_sum(id)) {
        std::vector<Term> terms = folded_terms(network, network.node(id).terms);
        network.node(id).terms = std::move(terms);
      }
    }
    for (int id = 0; id < size; ++id) {
      if (is_folded(id)) network.node(id).alive = false;
    }
    for (NetworkOutput& output : network.outputs) {
      if (!is_folded(output.node)) continue;
      const Term term = coefficient(network, *values_[at(output.node)]);
      output.node = term.factors[0];
      output.negative = output.negative != term.negative;
    }
    Trace result = to_trace(network, trace);
    result.drop_dead_code();  // terms that cancel when they are multiplied out leave theirs behind
    return result;
  }

  Trace fold(const SearchOptions& options) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      fold_.outputs.push_back({"folded", static_cast<int>(i), false, entries_[i]});
    }
    const Trace empty(&inputs_);
    return to_trace(searched(fold_, options), empty);
  }

  std::vector<std::string> names;

 private:
  /// A number alone stays where it is.
  [[nodiscard]] bool is_number(const Polynomial& value) const {
    return std::all_of(value.begin(), value.end(), [&](const Term& term) {
      return std::all_of(term.factors.begin(), term.factors.end(), [&](int factor) {
        return fold_.node(factor).kind == Node::Kind::kConstant;
      });
    });
  }

  [[nodiscard]] bool is_folded(int id) const {
    if (at(id) >= values_.size()) return false;  // ours
    return values_[at(id)] && !is_number(*values_[at(id)]);
  }

  std::optional<Polynomial> value_of(const Network& network, const SymbolTable& symbols, int id) {
    const Node& node = network.node(id);
    switch (node.kind) {
      case Node::Kind::kInput: {
        if (symbols.info(node.leaf).array != "chi") return {};
        const auto [it, added] = parameters_.emplace(node.name, 0);
        if (added) it->second = fold_.add(node);
        return Polynomial{{false, {it->second}}};
      }
      case Node::Kind::kConstant:
        return Polynomial{{false, {fold_.constant(node.leaf, node.name)}}};
      case Node::Kind::kInverse:
        return inverse(node.of);
      case Node::Kind::kSum:
        return sum(node.terms);
      case Node::Kind::kOpaque:
      case Node::Kind::kCall:
        break;
    }
    return {};
  }

  std::optional<Polynomial> inverse(int of) {
    const std::optional<Polynomial>& divisor = values_[at(of)];
    if (!divisor || is_number(*divisor)) return {};
    const auto [it, added] = inverses_.emplace(*divisor, 0);
    if (added) {
      const int sum = fold_.add({.terms = *divisor});
      it->second = fold_.add(
          {.kind = Node::Kind::kInverse, .name = "inverse_of_" + name_of(*divisor), .of = sum});
    }
    return Polynomial{{false, {it->second}}};
  }

  /// A term multiplied out; none if it is more than parameters.
  std::optional<Polynomial> multiplied(const Term& term) {
    Polynomial result = {{term.negative, {}}};
    for (const int factor : term.factors) {
      const std::optional<Polynomial>& value = values_[at(factor)];
      if (!value || result.size() * value->size() > kMostFoldedTerms) return {};
      Polynomial next;
      for (const Term& a : result) {
        for (const Term& b : *value) next.push_back(product(a, b));
      }
      result = std::move(next);
    }
    return result;
  }

  std::optional<Polynomial> sum(const std::vector<Term>& terms) {
    Polynomial result;
    for (const Term& term : terms) {
      const std::optional<Polynomial> own = multiplied(term);
      if (!own || result.size() + own->size() > kMostFoldedTerms) return {};
      result.insert(result.end(), own->begin(), own->end());
    }
    return normalised(fold_, std::move(result));
  }

  /// Terms with one coefficient each: a number or an entry of folded.
  std::vector<Term> folded_terms(Network& network, const std::vector<Term>& terms) {
    struct Group {
      Polynomial coefficient;
      std::vector<Term> originals;
    };
    std::vector<Term> result;
    std::map<std::vector<int>, Group> groups;  // by the factors that are no parameters
    for (const Term& term : terms) {
      Term parameters{term.negative, {}};
      std::vector<int> rest;
      for (const int factor : term.factors) {
        (values_[at(factor)] ? parameters.factors : rest).push_back(factor);
      }
      const std::optional<Polynomial> value = multiplied(parameters);
      if (!value) {
        result.push_back(factor_by_factor(network, term));
        continue;
      }
      Group& group = groups[rest];
      group.coefficient.insert(group.coefficient.end(), value->begin(), value->end());
      group.originals.push_back(term);
    }
    for (auto& [rest, group] : groups) {
      const Polynomial value = normalised(fold_, group.coefficient);
      if (value.empty()) continue;
      if (is_number(value)) {  // no parameters in it: as it was
        result.insert(result.end(), group.originals.begin(), group.originals.end());
        continue;
      }
      result.push_back(product(coefficient(network, value), {false, rest}));
    }
    return normalised(network, std::move(result));
  }

  /// A product of parameters that would be too long multiplied out: an entry for each.
  Term factor_by_factor(Network& network, const Term& term) {
    Term result{term.negative, {}};
    for (const int factor : term.factors) {
      result = product(result, is_folded(factor) ? coefficient(network, *values_[at(factor)])
                                                 : Term{false, {factor}});
    }
    return result;
  }

  /// The entry of folded for a polynomial, as a signed node of a function.
  Term coefficient(Network& network, Polynomial value) {
    const bool negative = value[0].negative;
    if (negative) {
      for (Term& term : value) term.negative = !term.negative;
    }
    const auto [it, added] = places_.emplace(value, static_cast<int>(entries_.size()));
    if (added) add_entry(value);
    const GiNaC::symbol& symbol = symbols_[at(it->second)];
    for (int id = 0; id < network.size(); ++id) {
      const Node& node = network.node(id);
      if (node.kind == Node::Kind::kInput && node.leaf.is_equal(symbol)) return {negative, {id}};
    }
    Node node;
    node.kind = Node::Kind::kInput;
    node.name = symbol.get_name();
    node.leaf = symbol;
    return {negative, {network.add(std::move(node))}};
  }

  void add_entry(const Polynomial& value) {
    const bool plain = value.size() == 1 && value[0].factors.size() == 1 &&
                       fold_.node(value[0].factors[0]).kind == Node::Kind::kInput;
    const std::string name = name_of(value);
    SymbolInfo info;
    info.name = "F_" + name;
    info.kind = SymbolKind::kParameter;
    info.array = "folded";
    info.index = static_cast<int>(entries_.size());
    info.shared = true;
    if (plain) info.unit = inputs_.info(fold_.node(value[0].factors[0]).leaf).unit;
    symbols_.push_back(inputs_.add(std::move(info)));
    names.push_back(symbols_.back().get_name());
    entries_.push_back(plain ? value[0].factors[0]
                             : fold_.add({.name = name, .terms = value, .place = next_place_++}));
  }

  /// "MX3", "ZZR3_minus_XXR3"; cut where it gets too long.
  [[nodiscard]] std::string name_of(const Polynomial& value) const {
    std::string name;
    for (const Term& term : value) {
      std::string factors;
      for (const int factor : term.factors) {
        const std::string& own = fold_.node(factor).name;
        factors += (factors.empty() ? "" : "_") + (own.empty() ? std::string("K") : own);
      }
      if (factors.empty()) factors = "one";
      if (!name.empty() && name.size() + factors.size() > kLongestName) return name + "_etc";
      if (!name.empty()) name += term.negative ? "_minus_" : "_plus_";
      name += factors;
    }
    return name;
  }

  SymbolTable& inputs_;
  Network fold_;
  std::map<std::string, int> parameters_;
  std::map<Polynomial, int, PolynomialLess> inverses_;  // divisor -> its inverse
  std::map<Polynomial, int, PolynomialLess> places_;    // in entries_
  std::vector<int> entries_;                            // nodes of fold_
  std::vector<GiNaC::symbol> symbols_;                  // of the entries
  std::vector<std::optional<Polynomial>> values_;       // of the function's nodes
  int next_place_ = 0;
};

}  // namespace

FoldedFunctions fold_parameters(const std::vector<Trace>& functions, SymbolTable& inputs,
                                const SearchOptions& options) {
  Folding folding(inputs);
  std::vector<Trace> folded;
  for (const Trace& function : functions) folded.push_back(folding.fold_function(function));
  Trace fold = folding.fold(options);
  return {std::move(folded), std::move(fold), std::move(folding.names)};
}

}  // namespace dyngen
