// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/body_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/emit_c/inline_trig.h"

namespace dyngen {
namespace {

/// Calls visit(symbol) for every symbol of a value.
template <class Visit>
void for_each_symbol(const GiNaC::ex& value, Visit visit) {
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it)) visit(*it);
  }
}

}  // namespace

Body::Body(const Trace& trace, const std::vector<Argument>& arguments, const EmitOptions& options,
           Width width)
    : trace_(trace),
      options_(options),
      width_(width),
      spelling_(options, trace.symbols(), width == Width::kLanes ? &varying_places_ : nullptr) {
  const SymbolTable& symbols = trace.symbols();
  const auto is_shared = [&](const std::string& array) {
    return std::any_of(arguments.begin(), arguments.end(), [&](const Argument& argument) {
      return argument.name == array && argument.shared;
    });
  };
  const auto read = [&](const GiNaC::ex& value) {
    for_each_symbol(value, [&](const GiNaC::ex& symbol) {
      const SymbolInfo& info = symbols.info(symbol);
      if (info.kind == SymbolKind::kConstant) {
        constant_places_.insert(symbols.place(symbol));
      } else if (!info.array.empty()) {
        arrays_.insert(info.array);
        if (!is_shared(info.array)) varying_places_.insert(symbols.place(symbol));
      }
    });
  };
  for (const Assignment& assignment : trace.assignments()) {
    read(assignment.value);
    if (varies(assignment.value)) varying_places_.insert(symbols.place(assignment.target));
  }
  for (const Output& output : trace.outputs()) read(output.value);
  if (options.trig == Trig::kInline || width == Width::kLanes) angles_ = find_angles(trace);
}

bool Body::varies(const GiNaC::ex& value) const {
  bool result = false;
  for_each_symbol(value, [&](const GiNaC::ex& symbol) {
    result = result || varying_places_.contains(trace_.symbols().place(symbol));
  });
  return result;
}

std::string Body::constants() const {
  std::string text;
  const auto add = [&](const SymbolInfo& info) {
    if (!constant_places_.contains(trace_.symbols().place(info.symbol))) return;
    std::string comment = info.unit;
    const bool formula = info.comment.starts_with("=");  // it stands in the enum of chi
    const std::string origin = formula ? "grouped" : info.comment;
    if (!origin.empty()) comment += (comment.empty() ? "" : ", ") + origin;
    text += fmt::format("  const {} {} = {};", spelling_.scalar(), info.name,
                        spelling_.number(info.value));
    text += comment.empty() ? "\n" : fmt::format(" /* {} */\n", comment);
  };
  if (trace_.symbols().parent() != nullptr) {
    for (const SymbolInfo& info : trace_.symbols().parent()->own()) add(info);
  }
  for (const SymbolInfo& info : trace_.symbols().own()) add(info);
  return text;
}

std::set<std::string> Body::helpers() const {
  std::set<std::string> names;
  for (const Assignment& assignment : trace_.assignments()) {
    if (find_sine(assignment.value, angles_)) continue;
    names.merge(spelling_.helpers(assignment.value));
  }
  return names;
}

std::string Body::type(const GiNaC::ex& value) const {
  return width_ == Width::kLanes && varies(value) ? options_.prefix + "_lanes" : spelling_.scalar();
}

std::string Body::statement(const Assignment& assignment) const {
  return wrap_statement(fmt::format("  const {} {} = {};", type(assignment.value),
                                    spelling_.symbol(assignment.target),
                                    spelling_.expression(assignment.value)));
}

/// The sines and cosines of all angles at once, before everything else: angles depend on inputs
/// alone.
std::string Body::gathered_angles() const {
  std::string text;
  std::vector<std::string> names;
  for (const GiNaC::ex& angle : angles_) {
    names.push_back(spelling_.symbol(angle));
    for (const Assignment& assignment : trace_.assignments()) {
      if (angle.is_equal(assignment.target)) text += statement(assignment);
    }
  }
  return text + (width_ == Width::kLanes ? sincos_lanes_calls(names, options_)
                                         : sincos_calls(names, options_));
}

std::string Body::gathered_value(const GiNaC::ex& value) const {
  const std::optional<SineOf> sine = find_sine(value, angles_);
  if (!sine) return {};
  return width_ == Width::kLanes ? sine_in_lanes(*sine) : sine_in_register(*sine, options_);
}

std::string Body::statements() const {
  std::string text;
  if (!angles_.empty()) {
    text += "\n  /* sines and cosines of the joint angles */\n" + gathered_angles();
  }
  int section = 0;
  for (const Assignment& assignment : trace_.assignments()) {
    if (is_one_of(angles_, assignment.target)) continue;
    const std::string gathered = gathered_value(assignment.value);
    if (assignment.section != section && !gathered.empty()) section = assignment.section;
    if (assignment.section != section) {
      section = assignment.section;
      const std::string& title = trace_.sections()[static_cast<std::size_t>(section)];
      text += "\n" + wrap_comment(title, "  /* ", "   * ") + " */\n";
    }
    text += gathered.empty() ? statement(assignment)
                             : fmt::format("  const {} {} = {};\n", type(assignment.value),
                                           spelling_.symbol(assignment.target), gathered);
  }
  return text;
}

}  // namespace dyngen
