// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_latex/emit_latex.h"

#include <fmt/format.h>

#include <filesystem>

#include "gen/emit_latex/latex_spelling.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

// TeX holds all lines of one align* at once, and breaks pages between them.
constexpr std::size_t kMostEquations = 60;

std::string latex_decimal(double value) { return latex_number(fmt::format("{:.10g}", value)); }

/// A multiple of pi as one, other numbers in decimals.
std::string latex_angle(const ex& angle) {
  if (angle.is_zero()) return "0";
  const ex share = angle / GiNaC::Pi;
  if (!share.info(GiNaC::info_flags::rational)) return latex_decimal(to_double(angle));
  const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(share);
  const long numerator = number.numer().to_long(), denominator = number.denom().to_long();
  const long magnitude = numerator < 0 ? -numerator : numerator;
  const std::string top = magnitude == 1 ? "\\pi" : fmt::format("{}\\pi", magnitude);
  return (numerator < 0 ? "-" : "") +
         (denominator == 1 ? top : fmt::format("\\frac{{{}}}{{{}}}", top, denominator));
}

std::string latex_length(const Quantity& length, const std::string& name) {
  return length.unknown ? latex_name(name) : latex_decimal(to_double(length.value));
}

/// "q_2 + pi/2", of a joint's own coordinate and what the file adds to it.
std::string with_coordinate(int coordinate, const std::string& offset) {
  std::string q = fmt::format("q_{{{}}}", coordinate + 1);
  if (offset == "0") return q;
  return q + (offset.starts_with('-') ? " - " + offset.substr(1) : " + " + offset);
}

std::string joints_table(const RobotModel& model) {
  const bool standard = model.convention == DhConvention::kStandard;
  std::string text = fmt::format(
      "\\section*{{Joints}}\n"
      "{} Denavit--Hartenberg parameters: frame $j$ stands on the frame of its parent by ${}$. "
      "Lengths in m, angles in rad.\n\n"
      "\\begin{{longtable}}{{rllrrrrr}}\n"
      "$j$ & name & type & parent & $\\alpha_j$ & $d_j$ & $\\theta_j$ & $r_j$ \\\\ \\hline\n"
      "\\endhead\n",
      standard ? "Standard" : "Modified",
      standard ? "R_z(\\theta_j)\\, T_z(r_j)\\, T_x(d_j)\\, R_x(\\alpha_j)"
               : "R_x(\\alpha_j)\\, T_x(d_j)\\, R_z(\\theta_j)\\, T_z(r_j)");
  for (int j = 1; j <= model.size(); ++j) {
    const JointModel& joint = model.joint(j);
    std::string theta = latex_angle(joint.theta);
    std::string r = latex_length(joint.r, fmt::format("r{}", j));
    const char* type = "fixed";
    if (joint.type == JointType::kRevolute) {
      theta = with_coordinate(joint.coordinate, theta);
      type = "revolute";
    } else if (joint.type == JointType::kPrismatic) {
      r = with_coordinate(joint.coordinate, r);
      type = "prismatic";
    }
    text += fmt::format("{} & {} & {} & {} & ${}$ & ${}$ & ${}$ & ${}$ \\\\\n", j,
                        latex_text(joint.name), type, joint.parent, latex_angle(joint.alpha),
                        latex_length(joint.d, fmt::format("d{}", j)), theta, r);
  }
  text += "\\end{longtable}\n\n";
  const auto component = [&](std::size_t k, const char* name) {
    return latex_length(model.gravity[k], name);
  };
  return text + fmt::format(
                    "The acceleration of the base in frame 0, which stands for gravity, is "
                    "$({}, {}, {})$ m/s$^2$.\n\n",
                    component(0, "gx"), component(1, "gy"), component(2, "gz"));
}

/// Equations in groups that TeX can hold.
class Equations {
 public:
  explicit Equations(std::string& text) : text_(text) {}
  Equations(const Equations&) = delete;
  Equations& operator=(const Equations&) = delete;
  ~Equations() { close(); }

  void add(const std::string& left, const std::vector<std::string>& terms) {
    if (count_ == kMostEquations) close();
    if (count_ == 0) text_ += "\\begin{align*}\n";
    text_ += latex_equation(left, terms);
    ++count_;
  }
  void close() {
    if (count_ == 0) return;
    text_.resize(text_.size() - std::string_view(" \\\\\n").size());  // of the last line
    text_ += "\n\\end{align*}\n";
    count_ = 0;
  }

 private:
  std::string& text_;
  std::size_t count_ = 0;
};

std::string parameters_text(const RobotModel& model, const BaseFormulas& formulas) {
  std::string text = fmt::format(
      "\\section*{{Base parameters}}\n"
      "The torque depends on {} combinations of the parameters of links "
      "and drives.\n",
      formulas.parameters.size());
  if (model.parameters == ParameterMeaning::kBase) {
    text += "The numbers of the robot file are base parameters themselves.\n";
  }
  {
    Equations equations(text);
    for (const BaseFormula& parameter : formulas.parameters) {
      equations.add(latex_name(parameter.name), latex_terms(parameter.formula));
    }
  }
  if (!formulas.symbolic) {
    text +=
        "The lengths of this arm are special: with others the set would be larger. The formulas "
        "hold for these lengths, in numbers.\n";
  }
  std::string lengths;
  for (const FormulaLength& length : formulas.lengths) {
    lengths += fmt::format("{}${} = {}$", lengths.empty() ? "" : ", ", latex_name(length.name),
                           length.value ? latex_decimal(*length.value) + "\\,\\mathrm{m}"
                                        : std::string("\\text{known at run time}"));
  }
  if (!lengths.empty()) text += "Lengths: " + lengths + ".\n";
  text += "\n\\begin{longtable}{lrl}\nparameter & value & unit \\\\ \\hline\n\\endhead\n";
  for (const BaseFormula& parameter : formulas.parameters) {
    text += fmt::format("${}$ & {} & {} \\\\\n", latex_name(parameter.name),
                        parameter.value ? "$" + latex_decimal(*parameter.value) + "$" : "unknown",
                        latex_unit(parameter.unit));
  }
  return text + "\\end{longtable}\n\n";
}

/// The named numbers that the program reads.
std::string numbers_text(const Trace& trace, const LatexSpelling& spelling) {
  std::set<int> read;
  const auto collect = [&](const ex& value) {
    for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
      if (GiNaC::is_a<GiNaC::symbol>(*it)) read.insert(trace.symbols().place(*it));
    }
  };
  for (const Assignment& assignment : trace.assignments()) collect(assignment.value);
  for (const Output& output : trace.outputs()) collect(output.value);
  std::string list;
  const auto add = [&](const SymbolTable& table) {
    for (const SymbolInfo& info : table.own()) {
      if (info.kind != SymbolKind::kConstant ||
          !read.contains(trace.symbols().place(info.symbol))) {
        continue;
      }
      list += fmt::format("{}${} = {}$", list.empty() ? "" : ", ", spelling.symbol(info.symbol),
                          latex_number(shortest_decimal(info.value)));
      if (!info.unit.empty()) list += "\\,\\mbox{" + latex_unit(info.unit) + "}";
    }
  };
  if (trace.symbols().parent() != nullptr) add(*trace.symbols().parent());
  add(trace.symbols());
  return list.empty() ? "" : "Numbers: " + list + ".\n\n";
}

std::string program_text(const RobotModel& model, const RobotFunction& id) {
  const Trace& trace = id.trace;
  const LatexSpelling spelling(trace);
  const OperationCount count = trace.count();
  std::string text = fmt::format(
      "\\section*{{Inverse dynamics}}\n"
      "Customised Newton--Euler recursion in {} multiplications and {} additions; the generated "
      "function \\texttt{{id}} has the same program with shared subexpressions. Each line reads "
      "what "
      "stands above it. A name has the components and the link of the recursion as its indices; "
      "one "
      "that begins with $m$ is minus the quantity.\n\n",
      count.multiplications, count.additions);
  if (model.convention == DhConvention::kStandard) {
    text +=
        "The program is written in the modified (proximal) frames of the same arm: its lengths "
        "are those below.\n\n";
  }
  text += numbers_text(trace, spelling);
  Equations equations(text);
  int section = 0;
  for (const Assignment& assignment : trace.assignments()) {
    if (assignment.section != section) {
      section = assignment.section;
      equations.close();
      const std::string& title = trace.sections()[static_cast<std::size_t>(section)];
      if (!title.empty()) text += "\\noindent " + latex_text(title) + "\n";
    }
    equations.add(spelling.symbol(assignment.target), spelling.terms(assignment.value));
  }
  equations.close();
  text += "\\noindent joint torques\n";
  for (const Output& output : trace.outputs()) {
    equations.add(
        output.array == "tau"
            ? fmt::format("\\tau_{{{}}}", output.index + 1)
            : fmt::format("\\mathit{{{}}}_{{{}}}^{{+}}",
                          output.array.substr(output.array.rfind('>') + 1), output.index + 1),
        spelling.terms(output.value));
  }
  equations.close();
  return text;
}

}  // namespace

std::string emit_latex(const RobotModel& model, const CodeModel& code, const RobotFunction& id,
                       const BaseFormulas& formulas) {
  std::string text = fmt::format(
      "% Generated by dyngen from {}.  Do not edit: edit the robot file and run dyngen again.\n"
      "\\documentclass[a4paper,10pt]{{article}}\n"
      "\\usepackage[T1]{{fontenc}}\n\\usepackage[utf8]{{inputenc}}\n"
      "\\usepackage[margin=2cm]{{geometry}}\n\\usepackage{{amsmath}}\n\\usepackage{{longtable}}\n"
      "\\allowdisplaybreaks\n\\setlength{{\\parindent}}{{0pt}}\n"
      "\\begin{{document}}\n"
      "\\section*{{Dynamics of \\texttt{{{}}}}}\n"
      "$q$, $\\dot{{q}}$, $\\ddot{{q}}$: coordinates of the joints (rad, m) and their derivatives; "
      "$\\tau$: torque of the drives (N\\,m, N).\n\n",
      std::filesystem::path(code.file_name).filename().string(), latex_text(model.name));
  text += joints_table(model);
  text += parameters_text(model, formulas);
  text += program_text(model, id);
  return text + "\\end{document}\n";
}

}  // namespace dyngen
