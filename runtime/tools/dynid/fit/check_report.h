// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/identification/fit.h"
#include "runtime/tools/dynid/recordings/loading.h"

namespace dyngen::runtime {

/// What dynid check found: how far the numbers of a file are from recordings.
struct CheckReport {
  struct Recording {
    RecordingLine line;
    double equations = 0;  ///< of a joint
    Residual residual;
    std::vector<int> two_encoders;  ///< joints that have them, from 0
  };
  std::string robot;
  std::vector<bool> revolute;  ///< of each joint
  int base_parameters = 0;
  std::vector<Recording> recordings;
};

/// Schema "dynid.check/1".
std::string check_json(const CheckReport& report);

}  // namespace dyngen::runtime
