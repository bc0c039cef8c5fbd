// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// The first finding with several names of a diagnosis, and what the file says besides that helps
/// to tell them apart.
struct OpenFinding {
  std::string robot;
  int joints = 0;
  int number = 0;  ///< of the finding in the file, from 1
  std::string family;
  int joint = 0;                     ///< from 1; 0: the whole robot
  int other = 0;                     ///< from 1; 0: none
  std::vector<std::string> aliases;  ///< families; its own first
  std::string formula;
  std::map<std::string, double> parameters;       ///< NaN: the file has null
  std::map<std::string, double> base_parameters;  ///< with the findings in
  std::vector<double> noise_floor;                ///< of each joint; NaN: not known
};

/// Reads what `dynid diagnose --json` writes (schema dynid.diagnosis/1).
/// @throws std::invalid_argument  with the file, what was found and what was expected; also where
///                                every finding has one name, so that nothing is left to separate
OpenFinding read_open_finding(const std::string& path);

}  // namespace dyngen::runtime
