// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/passes/conversion.h"
#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"
#include "gen/trace/angles.h"
#include "gen/trace/form.h"

namespace dyngen {
namespace {

using GiNaC::ex;

class Reading {
 public:
  explicit Reading(const Trace& trace) : trace_(trace) { find_opaque(); }

  Network run() {
    int place = 0;
    for (const Assignment& assignment : trace_.assignments()) {
      Node node;
      node.name = assignment.target.get_name();
      node.place = place++;
      node.section = assignment.section;
      if (opaque_.contains(node.name)) {
        node.kind = Node::Kind::kOpaque;
        node.leaf = assignment.value;
      } else {
        const Form form = canonical_form(assignment.value, trace_.symbols());
        if (is_call(form)) {
          named_[assignment.target.get_name()] = call(form.parts[0], std::move(node));
          continue;
        }
        node.terms = sum(form);
        if (const int inverse = lone_inverse(node.terms); inverse >= 0) {
          node.kind = Node::Kind::kInverse;
          node.of = network_.node(inverse).of;
          node.terms.clear();
        }
      }
      const std::string name = node.name;
      named_[name] = network_.add(std::move(node));
    }
    for (const Output& output : trace_.outputs()) {
      const std::vector<Term> terms = sum(canonical_form(output.value, trace_.symbols()));
      network_.outputs.push_back(wanted({output.array, output.index}, terms));
    }
    return std::move(network_);
  }

 private:
  /// Sines and cosines of what is known before everything else, and their angles; parameters are
  /// not among it, since they may be folded.
  void find_opaque() {
    std::vector<ex> angles;
    for (const ex& angle : find_angles(trace_)) {
      if (!reads_parameters(angle)) angles.push_back(angle);
    }
    for (const Assignment& assignment : trace_.assignments()) {
      const bool sine =
          is_sin_or_cos(assignment.value) && is_one_of(angles, assignment.value.op(0));
      if (sine || is_one_of(angles, assignment.target)) {
        opaque_.insert(assignment.target.get_name());
      }
    }
  }

  [[nodiscard]] bool reads_parameters(const ex& angle) const {
    const auto reads = [&](const ex& value) {
      for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
        if (GiNaC::is_a<GiNaC::symbol>(*it) &&
            trace_.symbols().info(*it).kind == SymbolKind::kParameter) {
          return true;
        }
      }
      return false;
    };
    if (reads(angle)) return true;
    return std::any_of(trace_.assignments().begin(), trace_.assignments().end(),
                       [&](const Assignment& assignment) {
                         return angle.is_equal(assignment.target) && reads(assignment.value);
                       });
  }

  NetworkOutput wanted(NetworkOutput output, const std::vector<Term>& terms) {
    if (terms.size() == 1 && terms[0].factors.size() == 1) {
      output.negative = terms[0].negative;
      output.node = terms[0].factors[0];
    } else {
      output.node = network_.add({.terms = terms});
    }
    return output;
  }

  std::vector<Term> sum(const Form& form) {
    DYNGEN_ASSERT(form.kind == Form::Kind::kSum, "a canonical form is a sum");
    std::vector<Term> terms;
    for (std::size_t i = 0; i < form.parts.size(); ++i) {
      const Form& part = form.parts[i];
      if (part.kind == Form::Kind::kNumber && part.leaf.is_zero()) continue;
      Term own = term(part);
      own.negative = own.negative != form.negative[i];
      terms.push_back(std::move(own));
    }
    return normalised(network_, std::move(terms));
  }

  /// The inverse that a sum is; -1 if it is something else.
  int lone_inverse(const std::vector<Term>& terms) const {
    if (terms.size() != 1 || terms[0].negative || terms[0].factors.size() != 1) return -1;
    const int id = terms[0].factors[0];
    return network_.node(id).kind == Node::Kind::kInverse ? id : -1;
  }

  static Term factor(int id) { return {false, {id}}; }

  Term term(const Form& form) {
    switch (form.kind) {
      case Form::Kind::kNumber:
        if (form.leaf.is_equal(1)) return {};
        return factor(network_.constant(form.leaf, {}));
      case Form::Kind::kSymbol:
        return factor(symbol(form.leaf));
      case Form::Kind::kCall:
        return factor(nested_call(form));
      case Form::Kind::kProduct: {
        Term result;
        for (const Form& part : form.parts) result = product(result, term(part));
        return result;
      }
      case Form::Kind::kQuotient: {
        const Term numerator = term(form.parts[0]);
        return product(numerator, factor(inverse(form.parts[1])));
      }
      case Form::Kind::kSum:
        break;
    }
    return factor(network_.add({.terms = sum(form)}));
  }

  int symbol(const ex& symbol) {
    const SymbolInfo& info = trace_.symbols().info(symbol);
    if (const auto it = named_.find(info.name); it != named_.end()) return it->second;
    DYNGEN_ASSERT(info.kind != SymbolKind::kIntermediate,
                  info.name + " is read before it is written");
    int id = 0;
    if (info.kind == SymbolKind::kConstant) {
      id = network_.constant(info.value, info.name);
    } else {
      id = network_.add({.kind = Node::Kind::kInput, .name = info.name, .leaf = symbol});
    }
    named_.emplace(info.name, id);
    return id;
  }

  /// @param node  its name and place
  int call(const Form& form, Node node) {
    std::vector<NetworkOutput> arguments;
    for (const Form& part : form.parts) {
      arguments.push_back(wanted({"", static_cast<int>(arguments.size())}, sum(part)));
    }
    node.kind = Node::Kind::kCall;
    node.call = form.call;
    const int id = network_.add(std::move(node));
    for (NetworkOutput& argument : arguments) {
      argument.call = id;
      network_.outputs.push_back(std::move(argument));
    }
    return id;
  }

  /// A call and nothing else, which is more than the sign of an input.
  [[nodiscard]] bool is_call(const Form& sum) const {
    if (sum.parts.size() != 1 || sum.negative[0]) return false;
    return sum.parts[0].kind == Form::Kind::kCall && !is_sign_of_inputs(sum.parts[0]);
  }

  [[nodiscard]] bool is_sign_of_inputs(const Form& form) const {
    return form.call == "sign" && reads_inputs_alone(form);
  }

  int nested_call(const Form& form) {
    return is_sign_of_inputs(form) ? sign_of_inputs(form) : call(form, {});
  }

  [[nodiscard]] bool reads_inputs_alone(const Form& form) const {
    if (form.kind == Form::Kind::kSymbol) {
      return trace_.symbols().info(form.leaf).kind == SymbolKind::kInput;
    }
    return std::all_of(form.parts.begin(), form.parts.end(),
                       [&](const Form& part) { return reads_inputs_alone(part); });
  }

  /// Its text is its identity.
  int sign_of_inputs(const Form& form) {
    const ex value = GiNaC::csgn(expression(form.parts[0]));
    for (int id = 0; id < network_.size(); ++id) {
      const Node& node = network_.node(id);
      if (node.kind == Node::Kind::kOpaque && node.leaf.is_equal(value)) return id;
    }
    return network_.add({.kind = Node::Kind::kOpaque, .leaf = value});
  }

  static ex expression(const Form& form) {
    if (form.kind == Form::Kind::kNumber || form.kind == Form::Kind::kSymbol) return form.leaf;
    DYNGEN_ASSERT(form.kind != Form::Kind::kCall, "a call within a call");
    ex result = form.kind == Form::Kind::kSum ? 0 : 1;
    for (std::size_t i = 0; i < form.parts.size(); ++i) {
      const ex part = expression(form.parts[i]);
      if (form.kind == Form::Kind::kSum) {
        result += form.negative[i] ? -part : part;
      } else {
        const bool divides = form.kind == Form::Kind::kQuotient && i > 0;
        result *= divides ? 1 / part : part;
      }
    }
    return result;
  }

  int inverse(const Form& form) {
    const Term of = term(form);
    const int divisor = of.factors.size() == 1 ? of.factors[0] : network_.add({.terms = {of}});
    return network_.add({.kind = Node::Kind::kInverse, .of = divisor});
  }

  const Trace& trace_;
  Network network_;
  std::set<std::string> opaque_;
  std::unordered_map<std::string, int> named_;
};

}  // namespace

Network to_network(const Trace& trace) { return Reading(trace).run(); }

}  // namespace dyngen
