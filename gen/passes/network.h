// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

#include "gen/symbols/symbol_table.h"

namespace dyngen {

/// A signed product of nodes; no factors: the number 1.
struct Term {
  bool negative = false;
  std::vector<int> factors;  ///< ascending; a square has its node twice

  bool operator==(const Term&) const = default;
};

/// Whether a node is among the factors of a term.
bool reads(const Term& term, int id);

/// A value that the program knows by one name, or could.
struct Node {
  enum class Kind {
    kInput,     ///< of the function
    kConstant,  ///< a number, named or not
    kOpaque,    ///< a call of inputs, or the angle of one: left as it stands
    kCall,      ///< a call of nodes, which stand in Network::outputs
    kInverse,   ///< 1 / node
    kSum,       ///< a sum of terms
  };
  Kind kind = Kind::kSum;
  std::string name{};         ///< of the statement; empty: none of its own yet
  GiNaC::ex leaf = 0;         ///< symbol or number; of kOpaque its value
  int of = -1;                ///< of kInverse
  std::string call{};         ///< of kCall: see call_name()
  std::vector<Term> terms{};  ///< of kSum: sorted by factors, none twice
  int place = -1;             ///< of the statement in the trace that was read
  int section = 0;
  bool negated = false;  ///< its value is minus what it was when it was read
  bool alive = true;
};

/// An element of an output array or an argument of a call: a node or its negation.
struct NetworkOutput {
  std::string array;  ///< empty: an argument
  int index = 0;
  bool negative = false;
  int node = -1;
  int call = -1;  ///< the node of which it is an argument
};

/// A program as sums of products over nodes with whole numbers for names: what the passes work on.
///
/// What a call takes is wanted as an output is: the passes shorten what stands before it and what
/// stands behind it, and know no more of it than of an input.
///
/// Nodes are never removed, only marked dead, so their numbers stay; numbers and the order of terms
/// depend on the program's text alone.
struct Network {
  std::vector<Node> nodes;
  std::vector<NetworkOutput> outputs;
  std::map<std::string, int> constants;  ///< by value to 40 digits: nodes of kConstant

  [[nodiscard]] const Node& node(int id) const { return nodes[static_cast<std::size_t>(id)]; }
  [[nodiscard]] Node& node(int id) { return nodes[static_cast<std::size_t>(id)]; }
  [[nodiscard]] bool is_sum(int id) const { return node(id).kind == Node::Kind::kSum; }
  [[nodiscard]] int size() const { return static_cast<int>(nodes.size()); }

  int add(Node node);
  /// The node of a number other than 0, 1 and -1.
  int constant(const GiNaC::ex& value, const std::string& name);
};

/// Multiplications, divisions and additions of a sum, or of all.
int operations(const std::vector<Term>& terms);
int operations(const Network& network);

/// Sorts terms, adds like ones, multiplies the constants of each.
std::vector<Term> normalised(Network& network, std::vector<Term> terms);

/// The product of two terms, not normalised.
Term product(const Term& a, const Term& b);

/// A sum with the value of one of its nodes in that node's place, not normalised.
std::vector<Term> written_out(const std::vector<Term>& terms, int id,
                              const std::vector<Term>& value);

/// Which nodes read each node; may name some that do not any more, or twice.
using Readers = std::vector<std::vector<int>>;
Readers find_readers(const Network& network);

/// How often each node is read: as a factor, by an inverse, as an output.
std::vector<int> count_uses(const Network& network);

}  // namespace dyngen
