// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "gen/tool/robot_options.h"
#include "gen/tool/usage_hint.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/options/parts.h"
#include "runtime/tools/dynid/options/recording_options.h"
#include "runtime/tools/dynid/robot/held_numbers.h"

namespace dyngen::runtime {
namespace {

constexpr const char* kFooter =
    "Recordings: CSV or CSV.gz with a header time,q1..qn,tau1..taun (SI units, joint side);\n"
    "of any other log 'dynid import' makes one, or --map reads it.\n"
    "Exit codes: 0 done, 1 input wrong, 2 usage, part absent, 3 data cannot support the answer.";

const std::map<std::string, StateMethod>& state_methods() {
  static const std::map<std::string, StateMethod> methods = {
      {"lowpass", StateMethod::kLowPass},
      {"kalman", StateMethod::kKalmanFilter},
      {"smoother", StateMethod::kKalmanSmoother},
      {"spectral", StateMethod::kSpectral},
      {"recorded", StateMethod::kRecorded}};
  return methods;
}

/// Texts of options that are not numbers, until they are understood.
struct Words {
  std::vector<std::string> methods;
  std::string state = "lowpass";
  std::string period = "auto";
};

/// How motion and equations come from a recording.
void add_state_options(CLI::App& command, ToolOptions& options, Words& words) {
  command
      .add_option("--state", words.state,
                  "joint state by lowpass, smoother, kalman, spectral or "
                  "recorded (qd, qdd columns)")
      ->check(CLI::IsMember(state_methods()))
      ->capture_default_str();
  command
      .add_option("--cutoff", options.motion.state.cutoff_hz,
                  "cut-off of the low-pass, Hz; 0: chosen from the data")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--decimate", options.rows.decimation,
                  "samples per equation, behind the parallel filter; 0: from the cut-off")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void add_motion_options(CLI::App& command, ToolOptions& options, Words& words) {
  add_state_options(command, options, words);
  command
      .add_option("--still", options.rows.still_speed,
                  "rad/s: slower joints give no equation; negative: 1 % of the largest speed")
      ->capture_default_str();
  command
      .add_option("--period", words.period,
                  "seconds, auto (periods are looked for and averaged) or off")
      ->capture_default_str();
  add_as_recorded(command, options.as_recorded);
}

void add_recordings(CLI::App& command, ToolOptions& options, const char* text) {
  command.add_option("recordings", options.recordings, text);
  command.add_option("--list", options.list,
                     "a file with one recording per line; fit goes through them one by one, in "
                     "as many processes as mpirun starts");
}

void add_effects(CLI::App& command, ToolOptions& options) {
  command
      .add_option("--effects", options.effects,
                  "a folder of further effect files (NAME.effect); may be given again")
      ->allow_extra_args(false);
}

void add_hold(CLI::App& command, ToolOptions& options) {
  command
      .add_option("--hold", options.hold,
                  fmt::format("numbers of the robot file that are kept, not estimated: {}; may be "
                              "given again",
                              kHoldForms))
      ->allow_extra_args(false);
}

/// The file with the numbers that were found, and what it is made of.
void add_identified(CLI::App& command, ToolOptions& options, const std::string& what) {
  command.add_option("-o,--output", options.output,
                     what +
                         "; .urdf or .xml: the robot's own URDF or MJCF, or that of --urdf or "
                         "--mjcf, with other numbers and every other byte as it was");
  CLI::Option* urdf = command.add_option("--urdf", options.description,
                                         "URDF of the robot that -o OUT.urdf is made of");
  command.add_option("--mjcf", options.description, "MJCF of the robot that -o OUT.xml is made of")
      ->excludes(urdf);
}

void add_fit(CLI::App& tool, ToolOptions& options, Words& words) {
  CLI::App* fit = tool.add_subcommand("fit", "identify a robot's parameters from recordings");
  add_robot(*fit, options.robot, "robot: its numbers are where the fit begins");
  add_recordings(*fit, options, "recordings, or .qr files of 'dynid accumulate'");
  add_map(*fit, options.map);
  fit->add_option("--holdout", options.heldout,
                  "recordings that are not fitted but predicted; may be given again");
  fit->add_option("--holdout-part", options.heldout_part,
                  "hold out the last part of every recording: 0.4 is the last 40 %")
      ->check(CLI::Range(0.0, 0.9));
  fit->add_option("--method", words.methods,
                  fmt::format("{}, or all: side by side", fmt::join(fit_method_names(), ", ")))
      ->allow_extra_args(false)
      ->default_str("wls");
  add_hold(*fit, options);
  fit->add_flag("--consistent", options.consistent,
                "full parameters of bodies that can exist, near the file's values");
  add_identified(*fit, options, "the identified robot file");
  fit->add_option("--json", options.json, "all results for programs");
  add_page_options(*fit, options.page);
  fit->add_option("--tracked", options.tracked,
                  "the commanded motion of the recording (CSV), for --method iv");
  fit->add_option("--lambda", options.fit.lambda, "of ridge; negative: corner of the L-curve")
      ->capture_default_str();
  fit->add_option("--prior", options.fit.prior_relative,
                  "how well the file's values are known: 0.3 is 30 %")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  fit->add_option("--drop", options.fit.dropped_directions,
                  "weakest directions that svd leaves out; negative: those not significant")
      ->capture_default_str();
  fit->add_option("--forgetting", options.fit.forgetting, "of rls, in (0, 1]")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  fit->add_option("--passes", options.fit.passes, "of lms over the data")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_effects(*fit, options);
  fit->add_flag("--own-friction", options.own_friction,
                "robots of .qr files share inertia; each has its own friction and offset");
  add_motion_options(*fit, options, words);
}

void add_atlas(CLI::App& tool, ToolOptions& options, Words& words) {
  CLI::App* atlas = tool.add_subcommand(
      "atlas", "what a refit hides of every effect, and how small it may be to be found");
  add_robot(*atlas, options.robot, "robot; with a trajectory, one with numbers");
  atlas->add_option("recordings", options.recordings, "recordings");
  add_map(*atlas, options.map);
  atlas->add_option("--trajectory", options.atlas.trajectory,
                    "a motion that is planned, instead of recordings (CSV)");
  atlas
      ->add_option("--noise", options.atlas.noise,
                   "standard deviation of the torque's noise, one number a joint, with commas; "
                   "else from the residual, or 1 % of the largest torque of a trajectory")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  add_effects(*atlas, options);
  atlas->add_option("--json", options.json, "all results for programs");
  add_page_options(*atlas, options.page);
  atlas->add_option("--picture", options.atlas.picture,
                    "how alike effects are, as a picture (.svg, .png)");
  add_motion_options(*atlas, options, words);
}

void add_diagnose(CLI::App& tool, ToolOptions& options, Words& words) {
  CLI::App* diagnose = tool.add_subcommand(
      "diagnose", "where model and recordings differ, which physics was left out, and the proof");
  add_robot(*diagnose, options.robot, "robot: its numbers are where the fit begins");
  diagnose->add_option("recordings", options.recordings, "recordings");
  add_map(*diagnose, options.map);
  diagnose->add_option("--holdout", options.heldout,
                       "recordings that only prove the answer; may be given again. Else a fifth of "
                       "every recording: the last in which all joints move");
  add_hold(*diagnose, options);
  add_effects(*diagnose, options);
  add_identified(*diagnose, options, "the robot file with what was found");
  diagnose->add_option("--json", options.json, "all results for programs");
  add_page_options(*diagnose, options.page);
  add_diagnose_options(*diagnose, options.diagnose);
  add_state_options(*diagnose, options, words);
  add_as_recorded(*diagnose, options.as_recorded);
}

void add_others(CLI::App& tool, ToolOptions& options, Words& words) {
  CLI::App* check = tool.add_subcommand("check", "residuals of a robot file, without a fit");
  add_robot(*check, options.robot, "robot with numbers");
  add_effects(*check, options);
  add_recordings(*check, options, "recordings");
  add_map(*check, options.map);
  check->add_option("--json", options.json, "all results for programs");
  add_motion_options(*check, options, words);

  CLI::App* accumulate =
      tool.add_subcommand("accumulate", "sum recordings up in a .qr file that merges with others");
  add_robot(*accumulate, options.robot, "robot");
  add_recordings(*accumulate, options, "recordings");
  add_map(*accumulate, options.map);
  accumulate->add_option("-o,--output", options.output, "the .qr file")->required();
  accumulate->add_option("--name", options.robot_name,
                         "whose recordings these are; robots of different names stay apart");
  add_motion_options(*accumulate, options, words);

  CLI::App* merge = tool.add_subcommand("merge", "merge .qr files");
  add_recordings(*merge, options, ".qr files");
  merge->add_option("-o,--output", options.output, "the merged .qr file")->required();
}

int usage(const std::string& message) {
  std::cerr << "dynid: " << message << "\nRun with --help for usage.\n";
  return kUsage;
}

/// Whether a file is called like a recording or a log, and like no robot.
bool is_log_name(const std::string& path) {
  constexpr std::array<std::string_view, 14> kLogs = {".csv",  ".csv.gz", ".txt.gz", ".mat", ".db3",
                                                      ".mcap", ".bag",    ".npz",    ".npy", ".h5",
                                                      ".hdf5", ".json",   ".jsonl",  ".qr"};
  return std::any_of(kLogs.begin(), kLogs.end(),
                     [&](std::string_view ending) { return path.ends_with(ending); });
}

/// A recording or a log in the robot's place, in the words of the command; empty: there is none.
std::string log_in_robots_place(const ToolOptions& options) {
  const bool simulates = options.command == Command::kSimulate;
  const std::string& path = simulates ? options.simulate.robot.path : options.robot.path;
  if (!is_log_name(path)) return {};
  std::string order = "recordings after it";
  if (simulates) order = "the trajectory behind --trajectory";
  if (options.command == Command::kExcite) order = "earlier recordings behind --prior";
  if (options.command == Command::kImport) order = "logs without an option";
  return fmt::format("found '{}' where the robot stands: expected the robot {}, {}", path,
                     options.command == Command::kImport ? "behind --robot" : "first", order);
}

/// @return a message about wrong usage, or nothing
std::string understand(const Words& words, ToolOptions& options) {
  options.motion.state.method = state_methods().at(words.state);
  if (words.period == "off") {
    options.motion.average_periods = false;
  } else if (words.period != "auto") {
    char* end = nullptr;
    const double seconds = std::strtod(words.period.c_str(), &end);
    if (*end != '\0' || !(seconds > 0)) {
      return fmt::format("--period: found '{}', expected seconds, auto or off", words.period);
    }
    options.motion.period = seconds;
  }
  if (!words.methods.empty()) options.fit.methods.clear();
  for (const std::string& word : words.methods) {
    if (word == "all") {
      options.every_method = true;
      continue;
    }
    const std::optional<FitMethod> method = parse_fit_method(word);
    if (!method) {
      return fmt::format("--method: found '{}', expected {} or all", word,
                         fmt::join(fit_method_names(), ", "));
    }
    options.fit.methods.push_back(*method);
  }
  if (options.command == Command::kAtlas) {
    if (options.recordings.empty() == options.atlas.trajectory.empty()) {
      return "expected recordings, or --trajectory FILE";
    }
    return "";
  }
  if (options.recordings.empty() && options.list.empty()) {
    return "there is no recording: expected at least one";
  }
  return "";
}

/// The subcommand that was called; nothing: none.
std::optional<Command> command_of(const CLI::App& tool) {
  static const std::map<std::string, Command> commands = {{"fit", Command::kFit},
                                                          {"check", Command::kCheck},
                                                          {"accumulate", Command::kAccumulate},
                                                          {"merge", Command::kMerge},
                                                          {"simulate", Command::kSimulate},
                                                          {"excite", Command::kExcite},
                                                          {"atlas", Command::kAtlas},
                                                          {"effects", Command::kEffects},
                                                          {"diagnose", Command::kDiagnose},
                                                          {"import", Command::kImport}};
  if (tool.get_subcommands().empty()) return std::nullopt;
  return commands.at(tool.get_subcommands().front()->get_name());
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  ParsedOptions parsed;
  Words words;
  CLI::App tool("Identifies the parameters of a robot's dynamics from recordings.", "dynid");
  tool.footer(kFooter);
  tool.set_version_flag("--version", [] { return "dynid " DYNGEN_VERSION "\n" + parts_text(); });
  tool.require_subcommand(1);
  add_fit(tool, parsed.options, words);
  add_others(tool, parsed.options, words);
  add_atlas(tool, parsed.options, words);
  add_diagnose(tool, parsed.options, words);
  parsed.options.page.command = command_text(argc, argv);
  add_simulate(tool, parsed.options.map, parsed.options.simulate);
  add_effects(tool, parsed.options.catalogue);
  add_import(tool, parsed.options.robot, parsed.options.output, parsed.options.import);
  add_as_recorded(*add_excite(tool, parsed.options.robot, parsed.options.map, parsed.options.output,
                              parsed.options.json, parsed.options.page, parsed.options.excite),
                  parsed.options.as_recorded);
  try {
    tool.parse(argc, argv);
  } catch (const CLI::Success& ended) {  // --help, --version, --print-rules
    parsed.exit_code = tool.exit(ended);
    return parsed;
  } catch (const CLI::ParseError& error) {
    // files in another order are one too many, or one too few
    parsed.options.command = command_of(tool).value_or(Command::kFit);
    const std::string order = log_in_robots_place(parsed.options);
    parsed.exit_code = usage(order.empty() ? usage_message(tool, argc, argv, error.what()) : order);
    return parsed;
  }
  parsed.options.command = command_of(tool).value();
  const std::string order = log_in_robots_place(parsed.options);
  if (!order.empty()) {
    parsed.exit_code = usage(order);
    return parsed;
  }
  SimulateOptions& simulate = parsed.options.simulate;
  simulate.plant = simulate.robot.beside(simulate.plant.path);
  if (parsed.options.command == Command::kSimulate || parsed.options.command == Command::kEffects) {
    return parsed;
  }
  const std::string message = parsed.options.command == Command::kExcite
                                  ? parsed.options.excite.usage_error()
                              : parsed.options.command == Command::kImport
                                  ? parsed.options.import.settle(parsed.options.output)
                                  : understand(words, parsed.options);
  if (!message.empty()) parsed.exit_code = usage(message);
  return parsed;
}

ToolOptions with_list(ToolOptions options) {
  if (options.list.empty()) return options;
  errno = 0;
  std::ifstream stream(options.list);
  if (!stream) {
    throw std::invalid_argument(
        fmt::format("--list: cannot read {}: {}", options.list, std::strerror(errno)));
  }
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line[0] != '#') options.recordings.push_back(line);
  }
  if (options.recordings.empty()) {
    throw std::invalid_argument(fmt::format("--list: no recording in {}", options.list));
  }
  return options;
}

}  // namespace dyngen::runtime
