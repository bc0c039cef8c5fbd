// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/adjoint.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/trace/form.h"

namespace dyngen {
namespace {

using GiNaC::ex;

std::string name_of(const ex& symbol) { return GiNaC::ex_to<GiNaC::symbol>(symbol).get_name(); }

/// A statement as it was before derivatives were added.
struct Step {
  GiNaC::symbol target;
  Form form;
};

class Reverse {
 public:
  Reverse(const Trace& function, const std::vector<DerivativeOutput>& wanted) : trace_(function) {
    for (const DerivativeOutput& derivative : wanted) active_.insert(name_of(derivative.input));
    for (const Assignment& assignment : trace_.assignments()) {
      Step step{assignment.target, canonical_form(assignment.value, trace_.symbols())};
      if (reads_active(step.form)) active_.insert(name_of(assignment.target));
      steps_.push_back(std::move(step));
    }
    outputs_ = trace_.take_outputs();
    trace_.section("derivatives of the statements above, last one first");
  }

  void weigh(const std::vector<WeightedOutput>& weights) {
    std::map<std::pair<std::string, int>, ex> by_element;
    for (const WeightedOutput& weight : weights) {
      by_element[{weight.array, weight.index}] += weight.weight;
    }
    for (const Output& output : outputs_) {
      const auto found = by_element.find({output.array, output.index});
      if (found == by_element.end()) continue;
      hand_on(canonical_form(output.value, trace_.symbols()), found->second, output.array);
    }
  }

  void sweep() {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      const std::string name = name_of(step->target);
      const ex derivative = take(name);
      if (!derivative.is_zero()) hand_on(step->form, derivative, name);
    }
  }

  Trace finish(const std::vector<DerivativeOutput>& wanted) {
    trace_.section("gradient");
    for (const DerivativeOutput& derivative : wanted) {
      trace_.output(derivative.array, derivative.index, take(name_of(derivative.input)));
    }
    trace_.drop_dead_code();
    return std::move(trace_);
  }

 private:
  [[nodiscard]] bool reads_active(const Form& form) const {
    if (form.kind == Form::Kind::kSymbol) return active_.contains(name_of(form.leaf));
    if (form.kind == Form::Kind::kCall && form.call == "sign") return false;
    return std::any_of(form.parts.begin(), form.parts.end(),
                       [&](const Form& part) { return reads_active(part); });
  }

  /// The derivative of s by what has this name, as a value with a name of its own.
  ex take(const std::string& name) {
    const auto found = derivatives_.find(name);
    return found == derivatives_.end() ? ex(0) : trace_.assign("B" + name, found->second);
  }

  static ex value_of(const Form& form) {
    switch (form.kind) {
      case Form::Kind::kNumber:
      case Form::Kind::kSymbol:
        return form.leaf;
      case Form::Kind::kSum: {
        ex sum = 0;
        for (std::size_t i = 0; i < form.parts.size(); ++i) {
          sum += form.negative[i] ? ex(-value_of(form.parts[i])) : value_of(form.parts[i]);
        }
        return sum;
      }
      case Form::Kind::kProduct: {
        ex product = 1;
        for (const Form& part : form.parts) product *= value_of(part);
        return product;
      }
      case Form::Kind::kQuotient:
        return value_of(form.parts[0]) / value_of(form.parts[1]);
      case Form::Kind::kCall: {
        const ex argument = value_of(form.parts[0]);
        if (form.call == "sin") return GiNaC::sin(argument);
        if (form.call == "cos") return GiNaC::cos(argument);
        DYNGEN_ASSERT(form.call == "sign", "a regressor has no such call: " + form.call);
        return GiNaC::csgn(argument);
      }
    }
    return 0;
  }

  /// Adds what a value with ds/dvalue = derivative hands on to the symbols in it.
  /// @param name  of the statement: what intermediate values are named after
  void hand_on(const Form& form, const ex& derivative, const std::string& name) {
    if (!reads_active(form)) return;
    switch (form.kind) {
      case Form::Kind::kNumber:
        return;
      case Form::Kind::kSymbol:
        derivatives_[name_of(form.leaf)] += derivative;
        return;
      case Form::Kind::kSum:
        for (std::size_t i = 0; i < form.parts.size(); ++i) {
          hand_on(form.parts[i], form.negative[i] ? ex(-derivative) : derivative, name);
        }
        return;
      case Form::Kind::kProduct:
        for (std::size_t i = 0; i < form.parts.size(); ++i) {
          if (!reads_active(form.parts[i])) continue;
          ex others = derivative;
          for (std::size_t k = 0; k < form.parts.size(); ++k) {
            if (k != i) others *= value_of(form.parts[k]);
          }
          if (form.parts[i].kind == Form::Kind::kSum) others = trace_.assign("B" + name, others);
          hand_on(form.parts[i], others, name);
        }
        return;
      case Form::Kind::kQuotient: {
        const ex divisor = value_of(form.parts[1]);
        const ex ratio = trace_.assign("B" + name, derivative / divisor);
        hand_on(form.parts[0], ratio, name);
        if (reads_active(form.parts[1])) {
          const ex whole = trace_.assign("Q" + name, value_of(form));
          hand_on(form.parts[1], trace_.assign("B" + name, -ratio * whole), name);
        }
        return;
      }
      case Form::Kind::kCall: {
        const ex argument = value_of(form.parts[0]);
        DYNGEN_ASSERT(form.call == "sin" || form.call == "cos",
                      "a regressor has no such call: " + form.call);
        // the other of the two is a statement as a rule: then this is its name
        const ex slope = form.call == "sin" ? trace_.assign("C" + name, GiNaC::cos(argument))
                                            : -trace_.assign("S" + name, GiNaC::sin(argument));
        hand_on(form.parts[0], trace_.assign("B" + name, derivative * slope), name);
        return;
      }
    }
  }

  Trace trace_;
  std::vector<Step> steps_;
  std::vector<Output> outputs_;
  std::set<std::string> active_;
  std::unordered_map<std::string, ex> derivatives_;  // ds/d(name), summed up so far
};

}  // namespace

Trace adjoint(const Trace& function, const std::vector<WeightedOutput>& weights,
              const std::vector<DerivativeOutput>& wanted) {
  Reverse reverse(function, wanted);
  reverse.weigh(weights);
  reverse.sweep();
  return reverse.finish(wanted);
}

}  // namespace dyngen
