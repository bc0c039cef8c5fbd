// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/options/loop_settings.h"

#include <CLI/CLI.hpp>

namespace dyngen::runtime {

std::vector<CLI::Option*> add_loop_settings(CLI::App& command, LoopSettings& settings) {
  std::vector<CLI::Option*> all;
  all.push_back(
      command
          .add_option("--controller", settings.controller,
                      "pd, gravity (pd and gravity), ff (pd and feedforward), ct (computed torque)")
          ->check(CLI::IsMember({"pd", "gravity", "ff", "ct"}))
          ->capture_default_str());
  all.push_back(command
                    .add_option("--rate", settings.rate,
                                "Hz, of controller and recording; 0: a continuous controller")
                    ->check(CLI::NonNegativeNumber)
                    ->capture_default_str());
  all.push_back(
      command.add_option("--bandwidth", settings.bandwidth, "Hz, natural frequency of the loop")
          ->check(CLI::PositiveNumber)
          ->capture_default_str());
  all.push_back(command.add_option("--damping", settings.damping, "damping ratio of the loop")
                    ->check(CLI::PositiveNumber)
                    ->capture_default_str());
  all.push_back(
      command
          .add_option("--encoder", settings.encoder, "rad or m: step of the positions; 0: exact")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(CLI::NonNegativeNumber)
          ->capture_default_str());
  all.push_back(command
                    .add_option("--encoder-noise", settings.encoder_noise,
                                "steps of --encoder: white noise before it rounds")
                    ->check(CLI::NonNegativeNumber)
                    ->capture_default_str());
  all.push_back(
      command
          .add_option("--velocity-cutoff", settings.velocity_cutoff,
                      "Hz: velocity is the encoder's difference behind this low-pass; 0: exact")
          ->check(CLI::NonNegativeNumber)
          ->capture_default_str());
  all.push_back(command.add_option("--delay", settings.delay, "s, from a sample to its torque")
                    ->check(CLI::NonNegativeNumber)
                    ->capture_default_str());
  all.push_back(command
                    .add_option("--friction-compensation", settings.friction,
                                "on, off; auto: on with ff and ct")
                    ->check(CLI::IsMember({"on", "off", "auto"}))
                    ->capture_default_str());
  all.push_back(command
                    .add_option("--friction-velocity", settings.friction_velocity,
                                "the velocity at which friction is compensated")
                    ->check(CLI::IsMember({"reference", "measured"}))
                    ->capture_default_str());
  all.push_back(command
                    .add_option("--friction-band", settings.friction_band,
                                "rad/s or m/s: below, compensation is linear in velocity")
                    ->delimiter(',')
                    ->allow_extra_args(false)
                    ->check(CLI::PositiveNumber)
                    ->capture_default_str());
  all.push_back(
      command.add_option("--saturate", settings.saturate, "on: torque is limited by taumax")
          ->check(CLI::IsMember({"on", "off"}))
          ->capture_default_str());
  all.push_back(command.add_option("--tolerance", settings.tolerance, "of the integration")
                    ->check(CLI::PositiveNumber)
                    ->capture_default_str());
  return all;
}

}  // namespace dyngen::runtime
