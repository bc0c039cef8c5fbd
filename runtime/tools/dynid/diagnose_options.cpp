// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose_options.h"

#include <CLI/CLI.hpp>
#include <cctype>

namespace dyngen::runtime {
namespace {

std::string quoted(const std::string& word) {
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

void add_diagnose_options(CLI::App& command, DiagnoseOptions& options) {
  command
      .add_option("--reference", options.reference,
                  "a recording of the same robot before it changed; may be given again")
      ->allow_extra_args(false);
  command.add_flag("--residual-only", options.diagnosis.residual_only,
                   "explain the torque that another simulator leaves (columns tausim1 ..): the "
                   "model's own parameters are not fitted");
  command.add_option("--report", options.report, "all results as a page to read (.html)");
  command
      .add_option("--false-alarm", options.diagnosis.false_alarm,
                  "how often a robot without fault may be accused, by the whole diagnosis")
      ->check(CLI::Range(1e-4, 0.49))
      ->capture_default_str();
  command.add_option("--seed", options.diagnosis.seed, "of the random numbers")
      ->capture_default_str();
}

std::string command_text(int argc, const char* const* argv) {
  std::string text = "dynid";
  for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
  return text;
}

}  // namespace dyngen::runtime
