// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/network.h"

#include <cln/cln.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {

bool reads(const Term& term, int id) {
  return std::binary_search(term.factors.begin(), term.factors.end(), id);
}
namespace {

using GiNaC::ex;

/// A number's text to 40 digits: equal for what differs by rounding at 60.
std::string value_key(const ex& value) {
  if (value.info(GiNaC::info_flags::rational)) {
    std::ostringstream text;
    text << value;
    return text.str();
  }
  const auto number = cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
  std::ostringstream text;
  text << cln::cl_float(number, cln::float_format(40));
  return text.str();
}

/// The number of a constant node.
ex constant_value(const Network& network, int id) { return network.node(id).leaf; }

bool is_constant(const Network& network, int id) {
  return network.node(id).kind == Node::Kind::kConstant;
}

/// The constant of a term apart from its other factors.
struct SplitTerm {
  std::vector<int> rest;
  std::vector<int> constants;
  ex value = 1;  ///< with the sign
};

SplitTerm split(const Network& network, const Term& term) {
  SplitTerm result;
  for (const int factor : term.factors) {
    if (is_constant(network, factor)) {
      result.constants.push_back(factor);
      result.value *= constant_value(network, factor);
    } else {
      result.rest.push_back(factor);
    }
  }
  if (term.negative) result.value = -result.value;
  return result;
}

std::string constant_name(const Network& network, int id) {
  const std::string& name = network.node(id).name;
  return name.empty() ? "K" : name;
}

/// @param settled  the number of the term
Term term_of(Network& network, std::vector<int> rest, const ex& settled, const std::string& name) {
  Term term;
  term.factors = std::move(rest);
  if (settled.is_equal(1)) return term;
  term.negative = settled.is_equal(-1);
  if (term.negative) return term;
  // a number and its negation are one constant
  term.negative = !network.constants.contains(value_key(settled)) &&
                  (network.constants.contains(value_key(-settled)) || number_sign(settled) < 0);
  const int id = network.constant(term.negative ? ex(-settled) : settled, name);
  term.factors.insert(std::upper_bound(term.factors.begin(), term.factors.end(), id), id);
  return term;
}

}  // namespace

int Network::add(Node node) {
  nodes.push_back(std::move(node));
  return size() - 1;
}

int Network::constant(const ex& value, const std::string& name) {
  const ex settled = rational_or_float(value);
  const auto [it, added] = constants.emplace(value_key(settled), size());
  if (added) {
    Node constant;
    constant.kind = Node::Kind::kConstant;
    constant.name = name;
    constant.leaf = settled;
    add(std::move(constant));
  }
  return it->second;
}

int operations(const std::vector<Term>& terms) {
  int count = std::max(static_cast<int>(terms.size()) - 1, 0);
  for (const Term& term : terms) {
    count += std::max(static_cast<int>(term.factors.size()) - 1, 0);
  }
  return count;
}

int operations(const Network& network) {
  int count = 0;
  for (const Node& node : network.nodes) {
    if (node.alive && node.kind == Node::Kind::kSum && !node.terms.empty()) {
      count += operations(node.terms);
    }
  }
  return count;
}

Term product(const Term& a, const Term& b) {
  Term result;
  result.negative = a.negative != b.negative;
  std::merge(a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end(),
             std::back_inserter(result.factors));
  return result;
}

std::vector<Term> normalised(Network& network, std::vector<Term> terms) {
  const auto by_factors = [](const Term& a, const Term& b) {
    return std::tie(a.factors, a.negative) < std::tie(b.factors, b.negative);
  };
  std::sort(terms.begin(), terms.end(), by_factors);
  std::vector<std::vector<int>> rests;  // without constants
  bool several_constants = false;
  for (const Term& term : terms) {
    std::vector<int> rest;
    for (const int factor : term.factors) {
      if (!is_constant(network, factor)) rest.push_back(factor);
    }
    several_constants = several_constants || rest.size() + 1 < term.factors.size();
    rests.push_back(std::move(rest));
  }
  std::sort(rests.begin(), rests.end());
  const bool like = std::adjacent_find(rests.begin(), rests.end()) != rests.end();
  if (!like && !several_constants) return terms;

  struct Sum {
    ex value = 0;
    std::string name;
    bool named = false;
    std::optional<Term> alone;  ///< the only term, if it has one constant at most
  };
  std::map<std::vector<int>, Sum> sums;
  for (const Term& term : terms) {
    const SplitTerm parts = split(network, term);
    const bool first = !sums.contains(parts.rest);
    Sum& sum = sums[parts.rest];
    sum.alone.reset();
    if (first && parts.constants.size() <= 1) sum.alone = term;
    std::string name;
    for (const int id : parts.constants) {
      name += (name.empty() ? "" : "_") + constant_name(network, id);
      sum.named = sum.named || !network.node(id).name.empty();
    }
    if (name.empty()) name = "one";
    sum.name += sum.name.empty() ? name : (term.negative ? "_minus_" : "_plus_") + name;
    sum.value += parts.value;
  }
  std::vector<Term> result;
  for (auto& [rest, sum] : sums) {
    if (sum.alone) {
      result.push_back(*sum.alone);
      continue;
    }
    const ex value = rational_or_float(sum.value);
    if (is_zero_number(value)) continue;
    result.push_back(term_of(network, rest, value, sum.named ? sum.name : std::string()));
  }
  std::sort(result.begin(), result.end(), by_factors);
  return result;
}

std::vector<int> count_uses(const Network& network) {
  std::vector<int> uses(network.nodes.size(), 0);
  const auto use = [&](int id) { ++uses[static_cast<std::size_t>(id)]; };
  for (const Node& node : network.nodes) {
    if (!node.alive) continue;
    for (const Term& term : node.terms) {
      for (const int factor : term.factors) use(factor);
    }
    if (node.kind == Node::Kind::kInverse) use(node.of);
  }
  for (const NetworkOutput& output : network.outputs) use(output.node);
  return uses;
}

Readers find_readers(const Network& network) {
  Readers readers(network.nodes.size());
  for (int reader = 0; reader < network.size(); ++reader) {
    const Node& node = network.node(reader);
    if (!node.alive) continue;
    for (const Term& term : node.terms) {
      for (const int factor : term.factors) {
        std::vector<int>& own = readers[static_cast<std::size_t>(factor)];
        if (own.empty() || own.back() != reader) own.push_back(reader);
      }
    }
    if (node.kind == Node::Kind::kInverse) {
      readers[static_cast<std::size_t>(node.of)].push_back(reader);
    }
  }
  return readers;
}

namespace {

/// A term with a sum written out in it.
std::vector<Term> expanded(const Term& term, int id, const std::vector<Term>& value) {
  Term rest{term.negative, {}};
  std::size_t power = 0;
  for (const int factor : term.factors) {
    if (factor == id) {
      ++power;
    } else {
      rest.factors.push_back(factor);
    }
  }
  std::vector<Term> result = {rest};
  for (std::size_t i = 0; i < power; ++i) {
    std::vector<Term> next;
    for (const Term& part : result) {
      for (const Term& own : value) next.push_back(product(part, own));
    }
    result = std::move(next);
  }
  return result;
}

}  // namespace

std::vector<Term> written_out(const std::vector<Term>& terms, int id,
                              const std::vector<Term>& value) {
  std::vector<Term> result;
  for (const Term& term : terms) {
    if (reads(term, id)) {
      std::vector<Term> parts = expanded(term, id, value);
      std::move(parts.begin(), parts.end(), std::back_inserter(result));
    } else {
      result.push_back(term);
    }
  }
  return result;
}

}  // namespace dyngen
