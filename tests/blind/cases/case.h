// SPDX-License-Identifier: MIT
// A case of the suite: a machine, what was left out of its model, and recordings of it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/blind/cases/logger.h"
#include "tests/blind/cases/strength.h"
#include "tests/blind/simulation/loop.h"
#include "tests/blind/truths/truth.h"

namespace blind {

struct CaseOptions {
  std::string kind = "null";     ///< null single pair hidden foreign passing crowd
  double lambda = 80;            ///< wanted strength of each effect; crowds draw it
  bool noisy = true;             ///< false: sensors without noise, to prove the simulation
  std::string family;            ///< empty: drawn
  int joint = 0;                 ///< of the effects, from 1, also where none is drawn; 0: drawn
  std::string arm;               ///< empty: drawn; "small": drawn of planar2 and twisted4
  std::string habit;             ///< of recording (habit.h); empty: the laboratory's
  std::optional<Colour> colour;  ///< of the torque's noise; nothing: drawn
  std::uint64_t seed = 0;
};

struct Case {
  std::string arm, engine, loop;
  CaseOptions options;
  Machine machine;
  Noise noise;
  double rate = 250, length = 0;  ///< 1/s; s of the first file
  int periods = 5;
  Logger logger;
  double disturbance = 0, memory = 0;  ///< torque in the loop: share of the torque's rms; s
  Eigen::VectorXd compensation;        ///< (j), as a draft has it
  std::vector<Truth> truths;
  std::vector<double> wanted;    ///< strength of each
  std::vector<double> sizes;     ///< of the truths
  std::vector<double> lambdas;   ///< of each alone
  std::vector<double> absorbed;  ///< share of its squares that the refit takes, each alone
  std::vector<Recording> training, heldout;
  double excess = 0;  ///< rms of what is left over the noise's, whitened
  /// Lambda of all truths together below 20 Hz, 40 ms and more from where a joint rests: what is in
  /// equations that are made of filtered positions and know no friction at rest.
  double filtered = 0;
  std::vector<double> heldout_oracle;      ///< rms by joint of who knows the truth's form, N m
  std::vector<double> heldout_base;        ///< rms by joint of the refitted base model
  std::map<std::string, double> imitated;  ///< share of a single truth's squares by other families
};

/// Draws and simulates. Nothing where this seed's physics does not reach the strength within its
/// bounds, or the machine runs away: the caller takes another seed.
/// @param arms  folder of the MJCF files
std::optional<Case> make_case(const CaseOptions& options, const std::string& arms);

/// All that a score needs and the diagnosis must not see.
nlohmann::json manifest_entry(const Case& made);

/// "white", "autoregressive", "mixed" or "pink".
std::string colour_name(Colour colour);

/// time,q1..qn,tau1..taun with all noise.
/// @param exact  with velocities and accelerations of the simulation
void write_recording(const Recording& recording, const Logger& logger, bool exact,
                     const std::string& path);

/// train1.csv ..., held1.csv ... and robot.robot.
void write_case(const Case& made, const std::string& arms, const std::string& folder);

}  // namespace blind
