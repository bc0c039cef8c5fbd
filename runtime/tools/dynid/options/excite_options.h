// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gen/robot_input/robot_source.h"
#include "runtime/tools/dynid/options/page_options.h"

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// The command line of `dynid excite`, as it is written.
struct ExciteOptions {
  std::string findings;              ///< of --for; empty: none
  std::vector<std::string> effects;  ///< folders of --effects, besides the program's own
  std::string criterion;             ///< condition, d, a, sigma; empty: the form's own
  std::string form = "fourier";      ///< fourier, spline, multistage
  bool unit_columns = false;
  int harmonics = 5;
  double duration = 10;        ///< s, one period
  double base_frequency = 0;   ///< Hz, 1 / duration; 0: not given
  double rate = 200;           ///< Hz, of the trajectory's rows
  std::optional<int> periods;  ///< that are written; none: as many as it takes
  int starts = 10;
  std::uint64_t seed = 1;
  double seconds = 60;
  int evaluations = 0;                  ///< 0: the clock ends it
  std::vector<double> noise;            ///< N m: one for all joints or one each
  std::vector<std::string> prior;       ///< earlier recordings, or one .qr file of them
  std::vector<std::string> parameters;  ///< names or kinds; empty: all
  std::vector<double> keep_out;         ///< xmin xmax ymin ymax zmin zmax
  std::vector<double> tool;             ///< x y z
  std::vector<double> acceleration;
  double limits = 1;            ///< share of the file's limits
  std::string picture;          ///< .svg or .png; empty: none
  std::string archetype;        ///< speeds, poses, sweeps; empty: none
  double hold = 0;              ///< s of a run, a pose or a sweep; 0: the archetype's own
  int count = 0;                ///< speeds, poses or sweeps; 0: the archetype's own
  std::vector<int> joints;      ///< that move, from 1; empty: all
  std::vector<double> posture;  ///< of joints that stand; empty: the middle of their ranges

  /// The criterion that was asked for; else sigma for multistage, condition for the others.
  [[nodiscard]] std::string chosen_criterion() const;
  /// @return a message about wrong usage, or nothing
  [[nodiscard]] std::string usage_error() const;
};

/// The subcommand and its options. @param map  of --map
CLI::App* add_excite(CLI::App& tool, RobotSource& robot, std::string& map, std::string& output,
                     std::string& json, PageOptions& page, ExciteOptions& options);

}  // namespace dyngen::runtime
