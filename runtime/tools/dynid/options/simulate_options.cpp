// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/simulate_options.h"

#include <CLI/CLI.hpp>

#include "gen/tool/robot_options.h"
#include "runtime/tools/dynid/options/recording_options.h"

namespace dyngen::runtime {

void add_simulate(CLI::App& tool, std::string& map, SimulateOptions& options) {
  CLI::App* simulate =
      tool.add_subcommand("simulate", "simulate a robot under a controller, and record it");
  add_robot(*simulate, options.robot, "robot with numbers: the controller's model");
  simulate->add_option("--plant", options.plant.path, "robot that moves; default: the same");
  simulate
      ->add_option("--trajectory", options.trajectory,
                   "CSV: time,q1..qn[,qd1..qdn][,qdd1..qddn]; two equal rows are a step")
      ->required();
  add_map(*simulate, map);
  simulate->add_option("-o,--output", options.output, "the recording (.csv, .csv.gz)")->required();
  simulate->add_option("--truth", options.truth,
                       "the true motion and torque, without encoder and noise");
  simulate->add_option("--picture", options.picture,
                       "motion, error and torque as .svg or .png (needs gnuplot)");
  add_loop_settings(*simulate, options.loop);
  simulate
      ->add_option("--torque-noise", options.torque_noise,
                   "N m or N: standard deviation of the recorded torque's noise")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--duration", options.duration, "s; 0: as long as the trajectory")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--seed", options.seed, "of the noise")->capture_default_str();
  simulate
      ->add_option("--start", options.start,
                   "rad or m: start at rest there; default: the trajectory's first sample")
      ->delimiter(',')
      ->allow_extra_args(false);
  simulate
      ->add_option("--temperature", options.temperature,
                   "of all joints, for effects that read it; two values: at start and end")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->expected(1, 2);
  simulate->add_option("--effects", options.effects, "a folder of effects of your own")
      ->allow_extra_args(false);
}

}  // namespace dyngen::runtime
