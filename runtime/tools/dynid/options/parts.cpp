// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "gen/xml/xml_document.h"
#include "runtime/estimation/matrix_products.h"
#include "runtime/import/map_file.h"
#include "runtime/plots/figure.h"
#include "runtime/recordings/gzip.h"
#include "runtime/tools/dynid/robot/write_back.h"

namespace dyngen::runtime {
namespace {

const PartWords& words_of_part(Part part) {
  return *std::find_if(all_parts().begin(), all_parts().end(),
                       [&](const PartWords& words) { return words.part == part; });
}

/// The first of many.
std::string few_of(const std::vector<std::string>& askers) {
  constexpr std::size_t kShown = 4;
  if (askers.size() <= kShown) return fmt::format("{}", fmt::join(askers, ", "));
  return fmt::format("{} and {} more", fmt::join(askers.begin(), askers.begin() + kShown, ", "),
                     askers.size() - kShown);
}

/// Parts that are needed, each with what of the command line needs it.
class Needs {
 public:
  void add(Part part, const std::string& asker) { askers_[part].push_back(asker); }
  void add_if(bool asked, Part part, const std::string& asker) {
    if (asked) add(part, asker);
  }
  /// A file that is read or written; empty: none.
  void add_file(const std::string& path) { add_if(path.ends_with(".gz"), Part::kZlib, path); }
  /// A robot, by what its name promises.
  void add_robot(const RobotSource& robot) {
    const std::string& path = robot.path;
    add_if(path.ends_with(".urdf") || path.ends_with(".xml"), Part::kExpat, path);
  }
  void add_files(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) add_file(path);
  }
  [[nodiscard]] const std::map<Part, std::vector<std::string>>& askers() const { return askers_; }

 private:
  std::map<Part, std::vector<std::string>> askers_;
};

/// Of fit, check, accumulate, atlas, excite and diagnose.
void add_common_needs(const ToolOptions& options, Needs& needs) {
  needs.add_if(!options.json.empty(), Part::kJson, "--json");
  needs.add_if(!options.page.report.empty(), Part::kJson, "--report");
  needs.add_if(!options.page.figures.empty(), Part::kGnuplot, "--figures");
  needs.add_robot(options.robot);
  needs.add_robot(options.description);
  needs.add_if(is_description_name(options.output), Part::kCeres, options.output);
  needs.add_files(options.recordings);
  needs.add_files(options.heldout);
  needs.add_if(!options.map.empty(), Part::kYaml, "--map");
}

void add_excite_needs(const ToolOptions& options, Needs& needs) {
  needs.add(Part::kNlopt, "excite");
  needs.add_if(!options.excite.findings.empty(), Part::kJson, "--for");
  needs.add_if(!options.excite.picture.empty(), Part::kGnuplot, "--picture");
  needs.add_file(options.output);
  needs.add_files(options.excite.prior);
}

void add_simulate_needs(const SimulateOptions& options, Needs& needs) {
  needs.add(Part::kBoost, "simulate");
  needs.add_if(!options.picture.empty(), Part::kGnuplot, "--picture");
  needs.add_robot(options.robot);
  needs.add_robot(options.plant);
  needs.add_files({options.trajectory, options.output, options.truth});
}

Needs needs_of(const ToolOptions& options, int processes) {
  Needs needs;
  needs.add_if(processes > 1, Part::kMpi, fmt::format("{} processes of mpirun", processes));
  add_common_needs(options, needs);
  switch (options.command) {
    case Command::kFit:
      needs.add_if(options.consistent, Part::kCeres, "--consistent");
      needs.add_file(options.tracked);
      break;
    case Command::kSimulate:
      add_simulate_needs(options.simulate, needs);
      break;
    case Command::kExcite:
      add_excite_needs(options, needs);
      break;
    case Command::kAtlas:
      needs.add_if(!options.atlas.picture.empty(), Part::kGnuplot, "--picture");
      needs.add_file(options.atlas.trajectory);
      break;
    case Command::kEffects:
      needs.add_if(!options.catalogue.figures.empty(), Part::kGnuplot, "--figures");
      break;
    case Command::kDiagnose:
      needs.add_if(!options.diagnose.loop.controller.empty(), Part::kBoost, "--controller");
      needs.add_files(options.diagnose.reference);
      needs.add_files(options.diagnose.commanded);
      break;
    case Command::kImport:
      needs.add_if(!options.import.map.empty(), Part::kYaml, "import");
      needs.add_files(options.import.logs);
      needs.add_file(options.output);
      break;
    case Command::kCheck:
    case Command::kAccumulate:
    case Command::kMerge:
      break;
  }
  return needs;
}

}  // namespace

const std::vector<PartWords>& all_parts() {
  static const std::vector<PartWords> parts = {
      {Part::kBoost, "Boost", "libboost-dev", "simulate, diagnose --controller"},
      {Part::kBzip2, "bzip2", "libbz2-dev", "ROS 1 bags packed with it"},
      {Part::kCeres, "Ceres", "libceres-dev", "fit --consistent"},
      {Part::kExpat, "expat", "libexpat1-dev", "robots as URDF and MJCF (.urdf, .xml)"},
      {Part::kGnuplot, "gnuplot", "gnuplot-nox", "--figures, --picture"},
      {Part::kHdf5, "HDF5", "libhdf5-dev", "logs in HDF5"},
      {Part::kZip, "libzip", "libzip-dev", "logs of NumPy in one file (.npz)"},
      {Part::kLz4, "lz4", "liblz4-dev", "MCAP files and ROS 1 bags packed with it"},
      {Part::kMatio, "matio", "libmatio-dev", "logs of MATLAB (.mat)"},
      {Part::kJson, "nlohmann-json", "nlohmann-json3-dev",
       "--json, --report, excite --for, logs in JSON"},
      {Part::kNlopt, "NLopt", "libnlopt-dev", "excite"},
      {Part::kBlas, "OpenBLAS", "libopenblas-pthread-dev", "a faster diagnose"},
      {Part::kMpi, "OpenMPI", "libopenmpi-dev", "fit in several processes, by mpirun"},
      {Part::kSqlite, "SQLite", "libsqlite3-dev", "logs of ROS 2 (.db3)"},
      {Part::kYaml, "yaml-cpp", "libyaml-cpp-dev", "import, --map"},
      {Part::kZlib, "zlib", "zlib1g-dev", "recordings and trajectories as .csv.gz"},
      {Part::kZstd, "zstd", "libzstd-dev", "MCAP files packed with it"}};
  return parts;
}

bool has_part(Part part) {
  // NOLINTBEGIN(bugprone-branch-clone): numbers of the build, which are equal where all is there
  switch (part) {
    case Part::kBlas:
      return multiplies_by_blas();
    case Part::kBoost:
      return DYNGEN_WITH_BOOST;
    case Part::kBzip2:
      return DYNGEN_WITH_BZIP2;
    case Part::kCeres:
      return DYNGEN_WITH_CERES;
    case Part::kExpat:
      return has_xml_reader();
    case Part::kGnuplot:
      return can_draw();
    case Part::kHdf5:
      return DYNGEN_WITH_HDF5;
    case Part::kJson:
      return DYNGEN_WITH_JSON;
    case Part::kLz4:
      return DYNGEN_WITH_LZ4;
    case Part::kMatio:
      return DYNGEN_WITH_MATIO;
    case Part::kMpi:
      return DYNGEN_WITH_MPI;
    case Part::kNlopt:
      return DYNGEN_WITH_NLOPT;
    case Part::kSqlite:
      return DYNGEN_WITH_SQLITE;
    case Part::kYaml:
      return import_maps_available();
    case Part::kZip:
      return DYNGEN_WITH_ZIP;
    case Part::kZlib:
      return gzip_available();
    case Part::kZstd:
      return DYNGEN_WITH_ZSTD;
  }
  // NOLINTEND(bugprone-branch-clone)
  return false;
}

std::string parts_text(const PresentParts& has) {
  std::string text;
  for (const PartWords& words : all_parts()) {
    text +=
        fmt::format("{}{:<8}{:<14} {:<24} {}", text.empty() ? "" : "\n",
                    has(words.part) ? "with" : "without", words.name, words.package, words.adds);
  }
  return text;
}

std::string missing_parts(const ToolOptions& options, int processes, const PresentParts& has) {
  const Needs needs = needs_of(options, processes);
  std::string text;
  for (const auto& [part, askers] : needs.askers()) {
    if (has(part)) continue;
    const PartWords& words = words_of_part(part);
    text += fmt::format("dynid: {}: ", few_of(askers));
    text += part == Part::kGnuplot
                ? fmt::format("gnuplot is not installed; install {}\n", words.package)
                : fmt::format("this dynid was built without {}; install {} and build it again\n",
                              words.name, words.package);
  }
  return text;
}

void call_absent(Part part) {
  throw std::logic_error(fmt::format(
      "a function of {} was called, which this dynid was built without", words_of_part(part).name));
}

}  // namespace dyngen::runtime
