// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_latex/latex_spelling.h"

#include <fmt/format.h>

#include "gen/symbols/exact.h"
#include "gen/words/characters.h"

namespace dyngen {
namespace {

// Characters of a formula that fit on a line of the page, as printed_length() counts them.
constexpr std::size_t kLineCharacters = 78;

/// About how many characters a formula has on paper: commands, braces and spaces have none.
std::size_t printed_length(std::string_view latex) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < latex.size(); ++i) {
    const char c = latex[i];
    if (c == '\\') {
      const std::size_t begin = i + 1;
      while (i + 1 < latex.size() && is_letter(latex[i + 1])) ++i;
      const std::string_view command = latex.substr(begin, i + 1 - begin);
      const bool printed = command == "sin" || command == "cos" || command == "tanh" ||
                           command == "exp" || command == "log" || command == "cdot";
      length += command.empty() ? 0 : printed ? command.size() : 0;
      if (command.empty()) ++i;  // "\,"
      continue;
    }
    if (c != '{' && c != '}' && c != '_' && c != '^' && c != ' ' && c != '&') ++length;
  }
  return length;
}

std::string upright(const std::string& letters) {
  return letters.size() == 1 ? letters : fmt::format("\\mathit{{{}}}", letters);
}

/// q, \dot q, \ddot q, tau of a joint; nothing if the array is another one.
std::string motion_symbol(const SymbolInfo& info) {
  const std::string joint = fmt::format("_{{{}}}", info.index + 1);
  if (info.array == "q") return "q" + joint;
  if (info.array == "dq") return "\\dot{q}" + joint;
  if (info.array == "ddq") return "\\ddot{q}" + joint;
  if (info.array == "tau") return "\\tau" + joint;
  return {};
}

}  // namespace

std::string latex_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        result += '\\';
        [[fallthrough]];
      default:
        result += c;
    }
  }
  return result;
}

std::string latex_unit(std::string_view unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (unit[i] == '^' && i + 1 < unit.size()) {
      text += fmt::format("$^{}$", unit[++i]);
    } else {
      text += unit[i] == ' ' ? std::string("\\,") : latex_text(unit.substr(i, 1));
    }
  }
  return text;
}

std::string latex_number(const std::string& decimal) {
  const std::size_t exponent = decimal.find('e');
  std::string digits = decimal.substr(0, exponent);
  if (digits.ends_with(".0")) digits.resize(digits.size() - 2);
  if (exponent == std::string::npos) return digits;
  return fmt::format("{} \\cdot 10^{{{}}}", digits, std::stoi(decimal.substr(exponent + 1)));
}

std::string latex_name(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '_') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  std::size_t letters = 0;
  while (letters < parts[0].size() && !is_digit(parts[0][letters])) ++letters;
  std::string subscript = parts[0].substr(letters);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    bool digits = true;
    for (const char c : parts[i]) digits = digits && is_digit(c);
    subscript += (subscript.empty() ? "" : ",") + (digits ? parts[i] : upright(parts[i]));
  }
  const std::string stem = upright(parts[0].substr(0, letters));
  return subscript.empty() ? stem : fmt::format("{}_{{{}}}", stem, subscript);
}

std::string latex_formula(const std::string& formula) {
  std::string result;
  for (std::size_t i = 0; i < formula.size();) {
    const std::size_t begin = i;
    if (is_letter(formula[i])) {
      while (i < formula.size() && (is_letter(formula[i]) || is_digit(formula[i]))) ++i;
      result += latex_name(formula.substr(begin, i - begin));
    } else if (is_digit(formula[i])) {
      while (i < formula.size() &&
             (is_digit(formula[i]) || formula[i] == '.' || formula[i] == 'e' ||
              ((formula[i] == '-' || formula[i] == '+') && formula[i - 1] == 'e'))) {
        ++i;
      }
      result += latex_number(formula.substr(begin, i - begin));
    } else if (formula[i] == '^') {
      ++i;
      const std::size_t digits = i;
      while (i < formula.size() && is_digit(formula[i])) ++i;
      result += fmt::format("^{{{}}}", formula.substr(digits, i - digits));
    } else {
      const bool between = formula[i] == ' ' && i > 0 && i + 1 < formula.size() &&
                           formula[i - 1] != '+' && formula[i - 1] != '-' &&
                           formula[i + 1] != '+' && formula[i + 1] != '-';
      result += between ? std::string("\\, ") : std::string(1, formula[i]);
      ++i;
    }
  }
  return result;
}

std::vector<std::string> latex_terms(const std::string& formula) {
  std::vector<std::string> terms;
  std::string term;
  int depth = 0;
  for (std::size_t i = 0; i < formula.size(); ++i) {
    const char c = formula[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const bool sign = depth == 0 && (c == '+' || c == '-') && i > 0 && formula[i - 1] == ' ';
    if (sign) {
      terms.push_back(latex_formula(term.substr(0, term.size() - 1)));
      term.clear();
    }
    term += c;
  }
  terms.push_back(latex_formula(term));
  return terms;
}

std::string latex_equation(const std::string& left, const std::vector<std::string>& terms) {
  std::string text = fmt::format("  {} &= ", left);
  std::size_t length = printed_length(left) + 1;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::size_t own = printed_length(terms[i]);
    if (i > 0 && length + own > kLineCharacters) {
      text += " \\\\\n    &\\quad ";
      length = 4;
    } else if (i > 0) {
      text += " ";
    }
    text += terms[i];
    length += own;
  }
  return text + " \\\\\n";
}

LatexSpelling::LatexSpelling(const Trace& trace) : trace_(trace) {
  std::set<std::string> taken;
  const auto add = [&](const SymbolTable& table) {
    for (const SymbolInfo& info : table.own()) {
      std::string name = motion_symbol(info);
      if (name.empty()) name = latex_name(info.name);
      if (!taken.insert(name).second) {
        name = fmt::format("\\mathtt{{{}}}", latex_text(info.name));
        taken.insert(name);
      }
      names_[trace.symbols().place(info.symbol)] = name;
    }
  };
  if (trace.symbols().parent() != nullptr) add(*trace.symbols().parent());
  add(trace.symbols());
}

std::string LatexSpelling::symbol(const GiNaC::ex& symbol) const {
  return names_.at(trace_.symbols().place(symbol));
}

std::string LatexSpelling::call(const Form& form) const {
  std::string arguments;
  for (const Form& part : form.parts) {
    arguments += (arguments.empty() ? "" : ", ") + this->form(part);
  }
  if (form.call == "sqrt") return fmt::format("\\sqrt{{{}}}", arguments);
  if (form.call == "abs") return fmt::format("\\left|{}\\right|", arguments);
  if (form.call == "pow") {
    return fmt::format("\\left({}\\right)^{{{}}}", this->form(form.parts[0]),
                       this->form(form.parts[1]));
  }
  std::string name = "\\" + form.call;
  if (form.call == "sign") name = "\\operatorname{sgn}";
  if (form.call == "phi") name = "\\varphi";
  if (form.call == "dphi") name = "\\varphi'";
  return fmt::format("{}({})", name, arguments);
}

std::string LatexSpelling::form(const Form& form) const {
  switch (form.kind) {
    case Form::Kind::kNumber:
      return latex_number(shortest_decimal(form.leaf));
    case Form::Kind::kSymbol:
      return symbol(form.leaf);
    case Form::Kind::kCall:
      return call(form);
    case Form::Kind::kQuotient:
      return fmt::format("\\frac{{{}}}{{{}}}", this->form(form.parts[0]),
                         this->form(form.parts[1]));
    case Form::Kind::kSum: {
      std::string text;
      for (std::size_t i = 0; i < form.parts.size(); ++i) {
        if (form.negative[i]) text += i > 0 ? " - " : "-";
        if (!form.negative[i] && i > 0) text += " + ";
        text += this->form(form.parts[i]);
      }
      return text;
    }
    case Form::Kind::kProduct:
      break;
  }
  std::string text;
  for (std::size_t i = 0; i < form.parts.size(); ++i) {
    const Form& part = form.parts[i];
    const std::string factor = this->form(part);
    if (i > 0) {
      const bool numbers = part.kind == Form::Kind::kNumber;
      text += numbers ? " \\cdot " : "\\, ";
    }
    text += part.kind == Form::Kind::kSum ? "(" + factor + ")" : factor;
  }
  return text;
}

std::vector<std::string> LatexSpelling::terms(const GiNaC::ex& value) const {
  const Form sum = canonical_form(value, trace_.symbols());
  std::vector<std::string> terms;
  for (std::size_t i = 0; i < sum.parts.size(); ++i) {
    const std::string sign = sum.negative[i] ? (i > 0 ? "- " : "-") : (i > 0 ? "+ " : "");
    terms.push_back(sign + form(sum.parts[i]));
  }
  return terms;
}

}  // namespace dyngen
