// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_script/script_spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

constexpr std::size_t kScriptColumns = 100;

}  // namespace

ScriptBody::ScriptBody(const ScriptLanguage& language, const Trace& trace,
                       const std::vector<Argument>& arguments)
    : language_(language), trace_(trace), arguments_(arguments) {
  for (const Assignment& assignment : trace.assignments()) {
    collect(canonical_form(assignment.value, trace.symbols()));
  }
  for (const Output& output : trace.outputs()) {
    collect(canonical_form(output.value, trace.symbols()));
  }
}

void ScriptBody::collect(const Form& form) {
  if (form.kind == Form::Kind::kCall) calls_.insert(form.call);
  if (form.kind == Form::Kind::kSymbol) read_.insert(trace_.symbols().place(form.leaf));
  for (const Form& part : form.parts) collect(part);
}

std::string ScriptBody::name(const GiNaC::ex& symbol) const {
  const SymbolInfo& info = trace_.symbols().info(symbol);
  if (!info.array.empty()) {
    const auto argument =
        std::find_if(arguments_.begin(), arguments_.end(),
                     [&](const Argument& entry) { return entry.name == info.array; });
    DYNGEN_ASSERT(argument != arguments_.end(), "a program reads its arguments alone");
    return language_.element(*argument, info.index);
  }
  if (info.name.size() <= language_.most_letters) return info.name;
  return fmt::format("V{}", trace_.symbols().place(symbol));  // a product of many named numbers
}

std::string ScriptBody::joined(const Form& form) const {
  std::string text;
  const bool sum = form.kind == Form::Kind::kSum, quotient = form.kind == Form::Kind::kQuotient;
  for (std::size_t i = 0; i < form.parts.size(); ++i) {
    const Form& part = form.parts[i];
    if (sum && i > 0) text += form.negative[i] ? " - " : " + ";
    if (sum && i == 0 && form.negative[0]) text += "-";
    if (!sum && i > 0) text += quotient ? language_.divide : language_.multiply;
    const bool brackets =
        part.kind == Form::Kind::kSum || (quotient && i > 0 && part.kind == Form::Kind::kProduct);
    text += brackets ? "(" + this->form(part) + ")" : this->form(part);
  }
  return text;
}

std::string ScriptBody::form(const Form& form) const {
  switch (form.kind) {
    case Form::Kind::kNumber:
      return shortest_decimal(form.leaf);
    case Form::Kind::kSymbol:
      return name(form.leaf);
    case Form::Kind::kCall: {
      const auto known = language_.calls.find(form.call);
      std::string text = (known == language_.calls.end() ? form.call : known->second) + "(";
      for (const Form& part : form.parts) {
        text += (&part == &form.parts.front() ? "" : ", ") + this->form(part);
      }
      return text + ")";
    }
    default:
      return joined(form);
  }
}

std::string ScriptBody::expression(const GiNaC::ex& value) const {
  return form(canonical_form(value, trace_.symbols()));
}

std::string ScriptBody::text(const std::string& indent) const {
  std::string text;
  const auto add_constants = [&](const SymbolTable& table) {
    for (const SymbolInfo& info : table.own()) {
      const bool used =
          info.kind == SymbolKind::kConstant && read_.contains(trace_.symbols().place(info.symbol));
      if (!used) continue;
      std::string comment = info.unit;
      const std::string origin = info.comment.starts_with("=") ? "grouped" : info.comment;
      if (!origin.empty()) comment += (comment.empty() ? "" : ", ") + origin;
      text += fmt::format("{}{} = {}{}{}\n", indent, name(info.symbol),
                          shortest_decimal(info.value), language_.end_of_statement,
                          comment.empty() ? "" : "  " + language_.comment + comment);
    }
  };
  if (trace_.symbols().parent() != nullptr) add_constants(*trace_.symbols().parent());
  add_constants(trace_.symbols());
  int section = 0;
  for (const Assignment& assignment : trace_.assignments()) {
    if (assignment.section != section) {
      section = assignment.section;
      const std::string& title = trace_.sections()[static_cast<std::size_t>(section)];
      if (!title.empty()) text += script_comment(title, indent + language_.comment);
    }
    text += wrap_script(fmt::format("{}{} = {}{}", indent, name(assignment.target),
                                    expression(assignment.value), language_.end_of_statement),
                        indent + "    ", language_.continued);
  }
  return text;
}

std::string wrap_script(const std::string& statement, const std::string& indent,
                        const std::string& continued) {
  std::string result;
  std::string line = statement;
  const std::size_t room = kScriptColumns - continued.size();
  while (line.size() > kScriptColumns) {
    std::size_t cut = std::string::npos;
    for (std::size_t i = indent.size() + 1; i + 2 < line.size() && i < room; ++i) {
      const bool sum =
          line[i] == ' ' && (line[i + 1] == '+' || line[i + 1] == '-') && line[i + 2] == ' ';
      const bool list = line[i] == ' ' && line[i - 1] == ',';
      if (sum || list) cut = i;
    }
    if (cut == std::string::npos) break;
    result += line.substr(0, cut) + continued + "\n";
    line = indent + line.substr(cut + 1);
  }
  return result + line + "\n";
}

std::string script_comment(const std::string& text, const std::string& begin) {
  std::istringstream words(text);
  std::string result, line = begin;
  bool empty = true;
  for (std::string word; words >> word; empty = false) {
    if (!empty && line.size() + 1 + word.size() > kScriptColumns) {
      result += line + "\n";
      line = begin;
      empty = true;
    }
    line += (empty ? "" : " ") + word;
  }
  return result + line + "\n";
}

std::string source_name(const CodeModel& code) {
  return std::filesystem::path(code.file_name).filename().string();
}

}  // namespace dyngen
