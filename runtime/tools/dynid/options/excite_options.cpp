// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/excite_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "gen/tool/robot_options.h"
#include "runtime/tools/dynid/options/recording_options.h"

namespace dyngen::runtime {
namespace {

/// Programmes of steady speeds and poses; what a search for a trajectory takes is not for them.
void add_archetypes(CLI::App& excite, ExciteOptions& options) {
  auto* archetype =
      excite
          .add_option("--archetype", options.archetype,
                      "speeds: each joint in turn at constant speeds; poses: held poses, each from "
                      "both sides; sweeps: each joint slowly over its range and back")
          ->check(CLI::IsMember({"speeds", "poses", "sweeps"}));
  for (const char* option : {"--for", "--criterion", "--unit-columns", "--form", "--harmonics",
                             "--duration", "--base-frequency", "--starts", "--seconds",
                             "--evaluations", "--noise", "--prior", "--parameters"}) {
    archetype->excludes(excite.get_option(option));
  }
  excite
      .add_option("--hold", options.hold,
                  "with --archetype: s of a run (6), in a pose (2), of a sweep one way (30)")
      ->check(CLI::PositiveNumber)
      ->needs(archetype);
  excite
      .add_option("--count", options.count,
                  "with --archetype: speeds (10), poses (20), sweeps there and back (2)")
      ->check(CLI::Range(1, 1000))
      ->needs(archetype);
  excite
      .add_option("--joints", options.joints,
                  "with --archetype: joints that move, from 1; default: all")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->needs(archetype);
  excite
      .add_option(
          "--posture", options.posture,
          "with --archetype: rad or m, one for each joint: where the others stand; default: "
          "the middle of their ranges")
      ->delimiter(',')
      ->needs(archetype);
}

}  // namespace

std::string ExciteOptions::chosen_criterion() const {
  if (!criterion.empty()) return criterion;
  return form == "multistage" ? "sigma" : "condition";
}

std::string ExciteOptions::usage_error() const {
  if (!keep_out.empty() && keep_out.size() != 6) {
    return fmt::format("--keep-out: {} values, expected xmin,xmax,ymin,ymax,zmin,zmax",
                       keep_out.size());
  }
  if (!tool.empty() && tool.size() != 3) {
    return fmt::format("--tool: {} values, expected x,y,z", tool.size());
  }
  if (form == "multistage" && chosen_criterion() != "sigma") {
    return fmt::format("--criterion: found '{}', expected sigma: multistage knows no other",
                       criterion);
  }
  if (form == "multistage" && !prior.empty()) {
    return "--prior: multistage knows of no earlier recordings; expected fourier or spline";
  }
  return "";
}

CLI::App* add_excite(CLI::App& tool, RobotSource& robot, std::string& map, std::string& output,
                     std::string& json, PageOptions& page, ExciteOptions& options) {
  CLI::App* excite =
      tool.add_subcommand("excite", "a trajectory whose recording says most of the parameters");
  add_robot(*excite, robot, "robot with limits qmin, qmax, vmax, amax, taumax");
  excite->add_option("-o,--output", output, "the trajectory (.csv, .csv.gz)")->required();
  excite->add_option("--json", json, "all results for programs");
  add_page_options(*excite, page);
  excite->add_option("--picture", options.picture,
                     "the trajectory as .svg or .png (needs gnuplot)");
  auto* findings =
      excite->add_option("--for", options.findings,
                         "the JSON of a diagnosis: a motion that tells the names of its first "
                         "finding with several apart");
  excite
      ->add_option("--effects", options.effects,
                   "with --for: a folder of effects of your own; may be given again")
      ->allow_extra_args(false)
      ->needs(findings);
  excite
      ->add_option("--criterion", options.criterion,
                   "condition number of the regressor (default); d: determinant, a: sum of "
                   "variances, sigma: smallest singular value (default of multistage)")
      ->check(CLI::IsMember({"condition", "d", "a", "sigma"}))
      ->excludes(findings);
  excite
      ->add_flag("--unit-columns", options.unit_columns,
                 "of the regressor with columns of length 1, instead of SI units")
      ->excludes(findings);
  excite->add_option("--form", options.form, "fourier, spline or multistage")
      ->check(CLI::IsMember({"fourier", "spline", "multistage"}))
      ->capture_default_str()
      ->excludes(findings);
  excite
      ->add_option("--harmonics", options.harmonics,
                   "of a Fourier series; a spline has twice as many inner control points")
      ->check(CLI::Range(2, 100))
      ->capture_default_str()
      ->excludes(findings);
  auto* duration = excite->add_option("--duration", options.duration, "of one period, s")
                       ->check(CLI::PositiveNumber)
                       ->capture_default_str();
  excite->add_option("--base-frequency", options.base_frequency, "Hz: 1 / duration")
      ->check(CLI::PositiveNumber)
      ->excludes(duration);
  excite->add_option("--rate", options.rate, "rows per second of the trajectory")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  excite
      ->add_option("--periods", options.periods,
                   "that are written one after the other; default: 5, with --for up to 20 as the "
                   "names take")
      ->check(CLI::Range(1, 1000));
  excite->add_option("--starts", options.starts, "random trajectories to begin from")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->excludes(findings);
  excite->add_option("--seed", options.seed, "of the first start")->capture_default_str();
  excite->add_option("--seconds", options.seconds, "to look for the best")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  excite
      ->add_option("--evaluations", options.evaluations,
                   "end after so many instead, which gives the same result every time")
      ->check(CLI::PositiveNumber);
  excite
      ->add_option("--noise", options.noise,
                   "standard deviation of a torque sample, N m: one for all joints or one each")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  excite
      ->add_option("--prior", options.prior,
                   "earlier recordings, to which this one shall add most, or a .qr file of them; "
                   "may be given again")
      ->allow_extra_args(false)
      ->excludes(findings);
  add_map(*excite, map);
  excite
      ->add_option("--parameters", options.parameters,
                   "names, or inertial, rotor, viscous, coulomb, offset; the others are taken as "
                   "known")
      ->delimiter(',')
      ->excludes(findings);
  excite
      ->add_option("--keep-out", options.keep_out,
                   "xmin,xmax,ymin,ymax,zmin,zmax in m, in the base frame: the tool's point stays "
                   "outside")
      ->delimiter(',');
  excite
      ->add_option("--tool", options.tool, "x,y,z in m: the tool's point in the last link's frame")
      ->delimiter(',');
  excite
      ->add_option("--acceleration", options.acceleration,
                   "limits instead of the file's amax: one for all joints or one each")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  excite->add_option("--limits", options.limits, "share of the file's limits that may be used")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  add_archetypes(*excite, options);
  return excite;
}

}  // namespace dyngen::runtime
