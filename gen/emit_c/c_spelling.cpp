// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/c_spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "gen/emit_c/call_helpers.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

constexpr std::size_t kCodeColumns = 100;

}  // namespace

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string function_macro(const EmitOptions& options) {
  return upper_case(options.prefix) + "_FUNCTION";
}

std::string helper_macro(const EmitOptions& options) {
  return upper_case(options.prefix) + "_HELPER";
}

std::string table_begin(const std::string& type, const std::string& name,
                        const EmitOptions& options) {
  // C++ takes an attribute of a constant in a declaration that says extern, and C wants no extern
  // in a definition
  const std::string table = fmt::format("const {} {}_{}[]", type, options.prefix, name);
  return fmt::format("extern {}_TABLE {};\n{} = {{\n", upper_case(options.prefix), table, table);
}

std::string CSpelling::scalar() const {
  return options_.scalar == Scalar::kDouble ? "double" : "float";
}

std::string CSpelling::number(const GiNaC::ex& value) const {
  return options_.scalar == Scalar::kDouble ? shortest_decimal(value)
                                            : shortest_decimal_float(value) + "f";
}

std::string CSpelling::element(const std::string& array, int index) {
  if (array == kStepArray || array == kPeriodArray) return array;
  return array + "[" + std::to_string(index) + "]";
}

std::string declared(const Argument& argument, const std::string& array,
                     const EmitOptions& options) {
  if (argument.state) return options.prefix + "_state *" + array;
  const std::string scalar = options.scalar == Scalar::kDouble ? "double" : "float";
  return (argument.output ? "" : "const ") + scalar + " *" + array;
}

std::string CSpelling::symbol(const GiNaC::ex& symbol) const {
  const SymbolInfo& info = symbols_.info(symbol);
  switch (info.kind) {
    case SymbolKind::kInput:
      return element(info.array, info.index);
    case SymbolKind::kParameter:
      return info.array + "[" + upper_case(options_.prefix) + "_" + info.name + "]";
    default:
      return info.name;
  }
}

/// True for what differs from sample to sample in a function of many samples.
bool CSpelling::in_lanes(const Form& form) const {
  if (varying_ == nullptr) return false;
  if (form.kind == Form::Kind::kSymbol) return varying_->contains(symbols_.place(form.leaf));
  return std::any_of(form.parts.begin(), form.parts.end(),
                     [this](const Form& part) { return in_lanes(part); });
}

std::string CSpelling::call(const Form& form) const {
  const bool lanes = in_lanes(form);
  std::string arguments;
  for (const Form& part : form.parts) {
    const bool spread = lanes && !in_lanes(part);
    const std::string text =
        spread ? options_.prefix + "_spread(" + this->form(part) + ")" : this->form(part);
    arguments += (arguments.empty() ? "" : ", ") + text;
  }
  std::string function = options_.prefix + "_" + form.call + (lanes ? "_lanes" : "");
  if (!lanes && !is_helper_call(form.call)) {
    function = c_library_name(form.call, options_.scalar);
  }
  return function + "(" + arguments + ")";
}

void CSpelling::collect_helpers(const Form& form, std::set<std::string>& names) const {
  for (const Form& part : form.parts) collect_helpers(part, names);
  if (form.kind != Form::Kind::kCall) return;
  const bool lanes = in_lanes(form);
  if (lanes || is_helper_call(form.call)) names.insert(form.call + (lanes ? "_lanes" : ""));
  const bool spreads = lanes && std::any_of(form.parts.begin(), form.parts.end(),
                                            [this](const Form& part) { return !in_lanes(part); });
  if (spreads) names.insert("spread");
}

std::set<std::string> CSpelling::helpers(const GiNaC::ex& value) const {
  std::set<std::string> names;
  collect_helpers(canonical_form(value, symbols_), names);
  return names;
}

std::string CSpelling::form(const Form& form) const {
  if (form.kind == Form::Kind::kCall) return call(form);
  if (form.kind == Form::Kind::kSum || form.kind == Form::Kind::kProduct ||
      form.kind == Form::Kind::kQuotient) {
    return join_operands(form, [this](const Form& part) { return this->form(part); });
  }
  return form.kind == Form::Kind::kNumber ? number(form.leaf) : symbol(form.leaf);
}

std::string CSpelling::expression(const GiNaC::ex& value) const {
  return form(canonical_form(value, symbols_));
}

std::string wrap_statement(const std::string& statement) {
  std::string result;
  std::string line = statement;
  const std::string indent = "      ";
  while (line.size() > kCodeColumns) {
    std::size_t cut = std::string::npos;
    for (std::size_t i = indent.size() + 1; i + 2 < line.size() && i < kCodeColumns; ++i) {
      const bool sum =
          line[i] == ' ' && (line[i + 1] == '+' || line[i + 1] == '-') && line[i + 2] == ' ';
      if (sum) cut = i;
    }
    if (cut == std::string::npos) break;
    result += line.substr(0, cut) + "\n";
    line = indent + line.substr(cut + 1);
  }
  return result + line + "\n";
}

std::string wrap_arguments(const std::string& declaration) {
  if (declaration.size() <= kCodeColumns) return declaration;
  const std::string indent(declaration.find('(') + 1, ' ');
  std::string result;
  std::string line = declaration;
  while (line.size() > kCodeColumns) {
    const std::size_t cut = line.rfind(", ", kCodeColumns - 1);
    if (cut == std::string::npos || cut < indent.size()) break;
    result += line.substr(0, cut + 1) + "\n";
    line = indent + line.substr(cut + 2);
  }
  return result + line;
}

std::string wrap_list(const std::string& first, const std::string& list) {
  std::string result;
  std::string line = first + list;
  while (line.size() > kCodeColumns) {
    const std::size_t cut = line.rfind(", ", kCodeColumns - 1);
    if (cut == std::string::npos || cut < 6) break;
    result += line.substr(0, cut + 1) + "\n";
    line = "      " + line.substr(cut + 2);
  }
  return result + line + "\n";
}

std::string wrap_comment(const std::string& text, const std::string& first,
                         const std::string& next) {
  std::istringstream words(text);
  std::string result;
  std::string line = first;
  std::string word;
  bool empty = true;
  while (words >> word) {
    if (!empty && line.size() + 1 + word.size() > kCodeColumns) {
      result += line + "\n";
      line = next;
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return result + line;
}

}  // namespace dyngen
