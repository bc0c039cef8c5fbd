// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulate_options.h"

#include <CLI/CLI.hpp>

namespace dyngen::runtime {

void add_simulate(CLI::App& tool, SimulateOptions& options) {
  CLI::App* simulate =
      tool.add_subcommand("simulate", "simulate a robot under a controller, and record it");
  simulate->add_option("robot", options.robot, "robot file with numbers: the controller's model")
      ->required();
  simulate->add_option("--plant", options.plant, "robot file of what moves; default: the same");
  simulate
      ->add_option("--trajectory", options.trajectory,
                   "CSV: time,q1..qn[,qd1..qdn][,qdd1..qddn]; two equal rows are a step")
      ->required();
  simulate->add_option("-o,--output", options.output, "the recording (.csv, .csv.gz)")->required();
  simulate->add_option("--truth", options.truth,
                       "the true motion and torque, without encoder and noise");
  simulate->add_option("--picture", options.picture,
                       "motion, error and torque as .svg or .png (needs gnuplot)");
  simulate
      ->add_option("--controller", options.controller,
                   "pd, gravity (pd and gravity), ff (pd and feedforward), ct (computed torque)")
      ->check(CLI::IsMember({"pd", "gravity", "ff", "ct"}))
      ->capture_default_str();
  simulate
      ->add_option("--rate", options.rate,
                   "Hz, of controller and recording; 0: a continuous controller")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--bandwidth", options.bandwidth, "Hz, natural frequency of the loop")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  simulate->add_option("--damping", options.damping, "damping ratio of the loop")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  simulate->add_option("--encoder", options.encoder, "rad or m: step of the positions; 0: exact")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate
      ->add_option("--velocity-cutoff", options.velocity_cutoff,
                   "Hz: velocity is the encoder's difference behind this low-pass; 0: exact")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate
      ->add_option("--torque-noise", options.torque_noise,
                   "N m or N: standard deviation of the recorded torque's noise")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--delay", options.delay, "s, from a sample to its torque")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--duration", options.duration, "s; 0: as long as the trajectory")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  simulate->add_option("--seed", options.seed, "of the noise")->capture_default_str();
  simulate
      ->add_option("--friction-compensation", options.friction, "on, off; auto: on with ff and ct")
      ->check(CLI::IsMember({"on", "off", "auto"}))
      ->capture_default_str();
  simulate
      ->add_option("--friction-velocity", options.friction_velocity,
                   "the velocity at which friction is compensated")
      ->check(CLI::IsMember({"reference", "measured"}))
      ->capture_default_str();
  simulate
      ->add_option("--friction-band", options.friction_band,
                   "rad/s or m/s: below, compensation is linear in velocity")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  simulate->add_option("--saturate", options.saturate, "on: torque is limited by taumax")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
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
  simulate->add_option("--tolerance", options.tolerance, "of the integration")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace dyngen::runtime
