// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/diagnose_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "runtime/tools/dynid/options/rules_file.h"

namespace dyngen::runtime {
namespace {

/// The controller under which held-out motions are simulated.
void add_simulation(CLI::App& command, DiagnoseOptions& options) {
  options.loop.controller.clear();
  const std::vector<CLI::Option*> loop = add_loop_settings(command, options.loop);
  CLI::Option* controller = loop.front();
  controller->description(
      "simulate the held-out motions under this controller, the model alone and with the "
      "findings, and compare with the recordings: " +
      controller->get_description());
  for (std::size_t i = 1; i < loop.size(); ++i) loop[i]->needs(controller);
  command
      .add_option("--controller-model", options.controller_model,
                  "robot file of the controller's model; default: the model alone, fitted")
      ->needs(controller);
  command
      .add_option("--commanded", options.commanded,
                  "CSV: what was commanded in a --holdout, one for each in their order; default: "
                  "the motion that was recorded")
      ->needs(controller);
}

}  // namespace

void add_diagnose_options(CLI::App& command, DiagnoseOptions& options) {
  command.add_option("--reference", options.reference,
                     "recordings of the same robot before it changed; may be given again");
  command.add_flag("--residual-only", options.diagnosis.residual_only,
                   "explain the torque that another simulator leaves (columns tausim1 ..): the "
                   "model's own parameters are not fitted");
  command
      .add_option("--false-alarm", options.diagnosis.false_alarm,
                  "how often a robot without fault may be accused, by the whole diagnosis")
      ->check(CLI::Range(1e-4, 0.49))
      ->capture_default_str();
  command.add_option("--seed", options.diagnosis.seed, "of the random numbers")
      ->capture_default_str();
  command
      .add_option("--effort", options.diagnosis.effort,
                  "work that the search may do, in 1e9 multiplications: the same answer on every "
                  "machine; 0: as much as it needs")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--most-findings", options.diagnosis.most_findings,
                  "findings after which the search ends; the answer says so")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--rules", options.rules,
                     "file of decision rules for studies: a name and a value on each line");
  command.add_flag_callback(
      "--print-rules",
      [] {
        fmt::print("{}", rules_text({}));
        throw CLI::Success();
      },
      "print all decision rules, as such a file, and end");
  add_simulation(command, options);
}

}  // namespace dyngen::runtime
