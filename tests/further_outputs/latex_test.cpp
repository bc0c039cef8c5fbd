// SPDX-License-Identifier: MIT
// --latex: a document that is well formed, and through pdflatex where there is one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "gen/emit_latex/emit_latex.h"
#include "gen/emit_latex/latex_spelling.h"
#include "tests/support/model_bridge.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test::latex_tests {
namespace {

using testing::HasSubstr;

std::string document(const std::string& path) {
  const RobotModel model = read_model(path);
  GeneratorOptions options;
  options.functions = {"id"};
  options.parameters = ParameterMode::kRuntime;
  const CodeModel code = make_code_model(model, options);
  const RobotFunction id = write_plain_function(parse_function_name("id"), code);
  const SymbolicRobot robot = make_symbolic(model);
  return emit_latex(model, code, id, base_formulas(model, robot, regroup(robot)));
}

/// What is wrong with the text as LaTeX; empty if nothing is found.
std::string fault(const std::string& text) {
  std::vector<std::string> open;
  int braces = 0;
  bool math = false, subscript = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '%' && (i == 0 || text[i - 1] != '\\')) {  // a comment
      while (i < text.size() && text[i] != '\n') ++i;
      continue;
    }
    if (c == '\\') {
      const std::size_t begin = ++i;
      while (i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0) ++i;
      const std::string command = text.substr(begin, i - begin);
      if (command == "begin" || command == "end") {
        const std::string name = text.substr(i + 1, text.find('}', i) - i - 1);
        if (command == "begin") {
          open.push_back(name);
        } else if (open.empty() || open.back() != name) {
          return "\\end{" + name + "} without its \\begin";
        } else {
          open.pop_back();
        }
      }
      if (!command.empty()) --i;
      continue;
    }
    if (c == '{') ++braces;
    if (c == '}' && --braces < 0) return "a brace too much";
    if (c == '$') {
      math = !math;
      subscript = false;
    }
    const bool in_math = math || (!open.empty() && open.back() == "align*");
    if (c == '_' && !in_math)
      return "'_' outside of a formula: " + text.substr(i > 20 ? i - 20 : 0, 40);
    if (c == '_') {
      if (subscript) return "two subscripts: " + text.substr(i > 20 ? i - 20 : 0, 40);
      subscript = true;
      std::size_t depth = 0;
      do {
        ++i;
        if (text[i] == '{') ++depth;
        if (text[i] == '}') --depth;
      } while (depth > 0);
      if (i + 1 < text.size() && text[i + 1] == '_') return "two subscripts";
      subscript = false;
    }
  }
  if (braces != 0) return "braces do not balance";
  if (math) return "a formula does not end";
  if (!open.empty()) return "\\begin{" + open.back() + "} without its \\end";
  return "";
}

class Latex : public testing::TestWithParam<std::string> {};

TEST_P(Latex, IsWellFormed) {
  const std::string text = document(GetParam());
  EXPECT_EQ(fault(text), "");
  EXPECT_THAT(text, HasSubstr("\\section*{Base parameters}"));
  EXPECT_THAT(text, HasSubstr("\\tau_{1}"));
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  EXPECT_LT(longest, 2000U);
}

TEST_P(Latex, CompilesWithPdflatex) {
  if (std::system("command -v pdflatex > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "there is no pdflatex (texlive-latex-base)";
  }
  const std::filesystem::path folder = temporary_path("latex");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "robot.tex") << document(GetParam());
  const std::string command = "cd '" + folder.string() +
                              "' && pdflatex -halt-on-error -interaction=nonstopmode robot.tex "
                              "> out.txt 2>&1";
  const int code = std::system(command.c_str());
  std::ifstream log(folder / "out.txt");
  std::ostringstream words;
  words << log.rdbuf();
  EXPECT_EQ(code, 0) << words.str().substr(words.str().size() > 3000 ? words.str().size() - 3000
                                                                     : 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "robot.pdf"));
  std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Robots, Latex,
                         testing::Values("robots/planar2r.robot", "robots/puma560.robot",
                                         "robots/scara.robot",
                                         "tests/robots/puma560_corke_std.robot",
                                         "tests/robots/odd_angles.robot", "tests/robots/rp.robot"),
                         [](const auto& entry) {
                           const std::string path = entry.param;
                           const std::size_t begin = path.rfind('/') + 1;
                           return path.substr(begin, path.rfind('.') - begin);
                         });

TEST(LatexSpelling, OfNamesNumbersAndFormulas) {
  EXPECT_EQ(latex_name("W1_3"), "W_{1,3}");
  EXPECT_EQ(latex_name("ZZR2"), "\\mathit{ZZR}_{2}");
  EXPECT_EQ(latex_name("S2_3"), "S_{2,3}");
  EXPECT_EQ(latex_number("1.5e-07"), "1.5 \\cdot 10^{-7}");
  EXPECT_EQ(latex_number("2.0"), "2");
  EXPECT_EQ(latex_formula("ZZ2 + d3^2 (M3 + M4)"),
            "\\mathit{ZZ}_{2} + d_{3}^{2}\\, (M_{3} + M_{4})");
  EXPECT_EQ(latex_text("a_b 50%"), "a\\_b 50\\%");
  EXPECT_EQ(latex_terms("ZZ2 - d3 (M3 - M4) + M5").size(), 3U);
}

TEST(LatexSpelling, CheckFindsFaults) {
  EXPECT_NE(fault("$a_{1}_{2}$"), "");
  EXPECT_NE(fault("{a"), "");
  EXPECT_NE(fault("\\begin{align*}a\\end{document}"), "");
  EXPECT_NE(fault("a_b"), "");
}

TEST(LatexSpelling, IsTheSameTextEveryTime) {
  EXPECT_EQ(document("robots/scara.robot"), document("robots/scara.robot"));
}

}  // namespace
}  // namespace dyngen::test::latex_tests
