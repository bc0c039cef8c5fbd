// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/tools/dynid/diagnose/diagnosis_report.h"

namespace dyngen::runtime {

/// What was found, lines of a comment.
std::vector<std::string> findings_comment(const DiagnosisReport& report,
                                          const DescribedRobot& robot);

/// The robot file with what a diagnosis found: the parameters of the model fitted together with the
/// findings, and a row `effect` for each finding behind those that the file has. Numbers read back
/// as they are, so that the file leaves the residual that the diagnosis says.
///
/// Of a diagnosis of another simulator's residual the parameters stay the file's.
/// @param robot  as it was diagnosed; parameters are those nearest to its own (nearest_standard())
std::string improved_text(const DiagnosisReport& report, const DescribedRobot& robot);

}  // namespace dyngen::runtime
