// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/input/output_paths.h"

#include <fmt/format.h>

#include <vector>

#include "gen/tool/output_files.h"

namespace dyngen::runtime {
namespace {

/// A file of the command line with the words by which a message speaks of it.
struct NamedPath {
  std::string name;
  std::string path;
};

/// Those that were given.
class NamedPaths {
 public:
  void add(const std::string& name, const std::string& path) {
    if (!path.empty()) paths_.push_back({name, path});
  }
  void add(const std::string& name, const std::vector<std::string>& paths) {
    for (const std::string& path : paths) add(name, path);
  }
  [[nodiscard]] const std::vector<NamedPath>& all() const { return paths_; }

 private:
  std::vector<NamedPath> paths_;
};

std::vector<NamedPath> inputs_of(const ToolOptions& options) {
  NamedPaths inputs;
  if (options.command == Command::kMerge) return {};
  inputs.add("the robot file", options.robot.path);
  inputs.add("the description", options.description);
  inputs.add("a recording", options.recordings);
  inputs.add("--map", options.map);
  inputs.add("the map", options.import.map);
  inputs.add("a log", options.import.logs);
  inputs.add("--list", options.list);
  inputs.add("--holdout", options.heldout);
  inputs.add("--tracked", options.tracked);
  inputs.add("--trajectory", options.atlas.trajectory);
  inputs.add("--for", options.excite.findings);
  inputs.add("--prior", options.excite.prior);
  inputs.add("--reference", options.diagnose.reference);
  inputs.add("--commanded", options.diagnose.commanded);
  inputs.add("--controller-model", options.diagnose.controller_model);
  inputs.add("the robot file", options.simulate.robot.path);
  inputs.add("--plant", options.simulate.plant.path);
  inputs.add("--trajectory", options.simulate.trajectory);
  return inputs.all();
}

std::vector<NamedPath> outputs_of(const ToolOptions& options) {
  NamedPaths outputs;
  outputs.add("-o", options.output);
  outputs.add("-o", options.simulate.output);
  outputs.add("--truth", options.simulate.truth);
  outputs.add("--json", options.json);
  outputs.add("--report", options.page.report);
  outputs.add("--picture", options.simulate.picture);
  outputs.add("--picture", options.excite.picture);
  outputs.add("--picture", options.atlas.picture);
  outputs.add("--markdown", options.catalogue.markdown);
  return outputs.all();
}

}  // namespace

std::string output_collision(const ToolOptions& options) {
  const std::vector<NamedPath> outputs = outputs_of(options);
  std::vector<NamedPath> others = inputs_of(options);
  for (const NamedPath& output : outputs) {
    for (const NamedPath& other : others) {
      if (!is_same_file(output.path, other.path)) continue;
      return fmt::format("{} and {} are the same file: '{}'; write to another one", output.name,
                         other.name, output.path);
    }
    others.push_back(output);
  }
  return "";
}

}  // namespace dyngen::runtime
