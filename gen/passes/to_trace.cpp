// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cctype>
#include <unordered_map>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/passes/conversion.h"
#include "gen/symbols/calls.h"

namespace dyngen {
namespace {

using GiNaC::ex;

class Writing {
 public:
  Writing(const Network& network, const Trace& source)
      : network_(network),
        source_(source),
        trace_(source.without_statements()),
        uses_(count_uses(network)),
        arguments_(network.nodes.size()),
        values_(network.nodes.size(), 0),
        written_(network.nodes.size(), false) {
    for (const NetworkOutput& output : network.outputs) {
      if (output.call >= 0) arguments_[static_cast<std::size_t>(output.call)].push_back(output);
    }
  }

  Trace run() {
    copy_constants();
    std::vector<int> order;
    for (int id = 0; id < network_.size(); ++id) {
      if (network_.node(id).alive && network_.node(id).place >= 0) order.push_back(id);
    }
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return network_.node(a).place < network_.node(b).place; });
    for (const int id : order) write(id, name_of(network_.node(id)), network_.node(id).section);
    int last_section = static_cast<int>(trace_.sections().size()) - 1;
    if (!source_.assignments().empty()) last_section = source_.assignments().back().section;
    for (const NetworkOutput& output : network_.outputs) {
      if (output.call >= 0) continue;
      const std::string name = output_name(output.array, output.index);
      write(output.node, name, last_section);
      const ex value = value_of(output.node);
      trace_.output(output.array, output.index, output.negative ? ex(-value) : value);
    }
    return std::move(trace_);
  }

 private:
  /// In their order in the source.
  void copy_constants() {
    for (const SymbolInfo& info : source_.symbols().own()) {
      if (info.kind != SymbolKind::kConstant) continue;
      symbols_[info.name] = trace_.constant(info.name, info.value, info.unit, info.comment);
    }
  }

  /// What is stored with its sign changed says so with an m, as in Trace::assign().
  static std::string name_of(const Node& node) {
    const std::string& name = node.name;
    if (!node.negated || name.empty()) return name;
    const bool marked =
        name.size() > 1 && name[0] == 'm' && std::isupper(static_cast<unsigned char>(name[1])) != 0;
    return marked ? name.substr(1) : "m" + name;
  }

  ex& value_of(int id) { return values_[static_cast<std::size_t>(id)]; }

  /// Written within its reader: it needs no name.
  bool is_nested(int id) const {
    const Node& node = network_.node(id);
    if (!node.name.empty()) return false;
    if (node.kind == Node::Kind::kInverse || node.kind == Node::Kind::kOpaque) return true;
    return uses_[static_cast<std::size_t>(id)] == 1;
  }

  /// A number without a symbol in a product: GiNaC would write it into a sum beside it.
  bool has_bare_number(const Term& term) {
    return std::any_of(term.factors.begin(), term.factors.end(),
                       [&](int factor) { return GiNaC::is_a<GiNaC::numeric>(value_of(factor)); });
  }

  void write(int id, const std::string& name, int section) {
    if (written_[static_cast<std::size_t>(id)]) return;
    written_[static_cast<std::size_t>(id)] = true;
    const Node& node = network_.node(id);
    switch (node.kind) {
      case Node::Kind::kInput:
        value_of(id) = node.leaf;
        return;
      case Node::Kind::kConstant:
        value_of(id) = constant(node);
        return;
      case Node::Kind::kOpaque: {
        const ex value = node.leaf.subs(renamed(node.leaf), GiNaC::subs_options::no_pattern);
        if (!node.name.empty()) {
          assign(id, node.name, value, section);
        } else {
          value_of(id) = value;
        }
        return;
      }
      case Node::Kind::kInverse:
        prepare(node.of, section, (node.name.empty() ? name : node.name) + "_divisor", true);
        if (!node.name.empty()) {
          assign(id, name, 1 / value_of(node.of), section);
        } else {
          value_of(id) = 1 / value_of(node.of);
        }
        return;
      case Node::Kind::kCall:
        assign(id, name, call(id, name, section), section);
        return;
      case Node::Kind::kSum:
        assign(id, name, sum(node, name, section), section);
        return;
    }
  }

  ex call(int id, const std::string& name, int section) {
    std::vector<ex> arguments;
    for (const NetworkOutput& argument : arguments_[static_cast<std::size_t>(id)]) {
      prepare(argument.node, section, name, true);
      const ex& value = value_of(argument.node);
      arguments.push_back(argument.negative ? ex(-value) : value);
    }
    return make_call(network_.node(id).call, arguments);
  }

  void assign(int id, const std::string& name, const ex& value, int section) {
    if (GiNaC::is_a<GiNaC::numeric>(value)) {
      value_of(id) = value;
      return;
    }
    const GiNaC::symbol target = trace_.append(name, value, section);
    symbols_[network_.node(id).name] = target;
    value_of(id) = target;
  }

  /// What stands for a node within another: written before it, or its expression in brackets.
  void prepare(int id, int section, const std::string& reader, bool may_nest) {
    const Node& node = network_.node(id);
    if (node.kind == Node::Kind::kSum && may_nest && is_nested(id)) {
      if (written_[static_cast<std::size_t>(id)]) return;
      written_[static_cast<std::size_t>(id)] = true;
      value_of(id) = sum(node, reader, section);
      return;
    }
    std::string name = node.name.empty() ? name_for(node, reader) : name_of(node);
    if (node.name.empty() && node.kind == Node::Kind::kCall) name = reader + "_" + node.call;
    if (node.name.empty() && node.kind == Node::Kind::kInverse) name = reader;
    write(id, name, section);
  }

  ex sum(const Node& node, const std::string& reader, int section) {
    ex result = 0;
    for (const Term& term : node.terms) {
      for (const int factor : term.factors) {
        if (!network_.is_sum(factor)) prepare(factor, section, reader, true);
      }
      const bool may_nest = term.factors.size() > 1 && !has_bare_number(term);
      for (const int factor : term.factors) {
        if (network_.is_sum(factor)) prepare(factor, section, reader, may_nest);
      }
      ex value = term.negative ? -1 : 1;
      for (const int factor : term.factors) value *= value_of(factor);
      result += value;
    }
    return result;
  }

  ex constant(const Node& node) {
    if (node.name.empty()) return node.leaf;
    return trace_.constant(node.name, node.leaf);
  }

  /// Symbols of the source's statements and constants -> those of the result.
  GiNaC::exmap renamed(const ex& value) {
    GiNaC::exmap result;
    for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
      if (!GiNaC::is_a<GiNaC::symbol>(*it)) continue;
      const auto known = symbols_.find(GiNaC::ex_to<GiNaC::symbol>(*it).get_name());
      if (known != symbols_.end()) result[*it] = known->second;
    }
    return result;
  }

  /// "C3_VP1_2", "YY3_minus_XX3"; what is longer is a part of its reader.
  std::string name_for(const Node& node, const std::string& reader) {
    std::string name;
    for (const Term& term : node.terms) {
      if (!name.empty()) name += term.negative ? "_minus_" : "_plus_";
      if (name.empty() && term.negative) name = "minus_";
      std::string factors;
      for (const int factor : term.factors) {
        const std::string own = name_of(network_.node(factor));
        if (own.empty()) return part_of(reader);
        factors += (factors.empty() ? "" : "_") + own;
      }
      name += factors.empty() ? "one" : factors;
      if (name.size() > kLongestName) return part_of(reader);
    }
    return name;
  }

  static std::string part_of(const std::string& reader) {
    return reader.find("_part") == std::string::npos ? reader + "_part" : reader;
  }

  const Network& network_;
  const Trace& source_;
  Trace trace_;
  std::vector<int> uses_;
  std::vector<std::vector<NetworkOutput>> arguments_;  // of calls
  std::vector<ex> values_;
  std::vector<bool> written_;
  std::unordered_map<std::string, ex> symbols_;  // names of the source -> of the result
};

}  // namespace

Trace to_trace(const Network& network, const Trace& source) {
  return Writing(network, source).run();
}

}  // namespace dyngen
