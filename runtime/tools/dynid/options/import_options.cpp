// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/import_options.h"

#include <CLI/CLI.hpp>

#include "gen/tool/robot_options.h"

namespace dyngen::runtime {

std::string ImportOptions::settle(const std::string& output) {
  if (list && guess) return "found --list and --guess, expected one of them";
  logs = files;
  if (!list && !guess) {
    if (files.empty()) return "there is no map: expected MAP.yaml and logs (--guess writes one)";
    map = files.front();
    logs.erase(logs.begin());
    if (output.empty()) return "expected -o: where the recording is written (.csv, .csv.gz)";
  }
  if (logs.empty()) return "there is no log: expected at least one";
  return "";
}

void add_import(CLI::App& tool, RobotSource& robot, std::string& output, ImportOptions& options) {
  CLI::App* import = tool.add_subcommand(
      "import", "make a recording of logs as they are, by a map of their columns");
  import
      ->add_option("files", options.files,
                   "MAP.yaml and logs (CSV and other text, .mat, HDF5, npz, bags, JSON); with "
                   "--list and --guess logs alone")
      ->required();
  import->add_option("-o,--output", output,
                     "the recording (.csv, .csv.gz); of --guess the map, else it is printed");
  import->add_option("--robot", robot.path,
                     "robot (.robot, URDF, MJCF or .par): its joints, their names and limits");
  add_robot_part(*import, robot);
  import->add_flag("--list", options.list, "say which tables and columns the logs have");
  import->add_flag("--guess", options.guess,
                   "write a map: what the columns are, with reasons, and with questions that are "
                   "to be answered");
}

}  // namespace dyngen::runtime
