// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/page_options.h"

#include <CLI/CLI.hpp>
#include <cctype>

namespace dyngen::runtime {
namespace {

std::string shell_word(const std::string& word) {
  const std::string plain = "_-+./:,=@%^";
  bool needed = word.empty();
  for (const char c : word) {
    needed = needed || (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
                        plain.find(c) == std::string::npos);
  }
  if (!needed) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

void add_page_options(CLI::App& command, PageOptions& options) {
  command.add_option("--report", options.report, "all results as a page to read (.html)");
  command.add_option("--figures", options.figures,
                     "a folder for the figures of the page, each as .svg, .png and .csv");
}

std::string command_text(int argc, const char* const* argv) {
  std::string text = "dynid";
  for (int i = 1; i < argc; ++i) text += " " + shell_word(argv[i]);
  return text;
}

}  // namespace dyngen::runtime
