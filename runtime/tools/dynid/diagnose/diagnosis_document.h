// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/report/document.h"
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"

namespace dyngen::runtime {

/// The page of a diagnosis, in the order in which a person asks: the verdict; of each finding where
/// it is, what, how much, its model, the proof, what it changed and what is next; then what was not
/// found, what is open, what the recordings are like, and how the answer was made.
ReportDocument diagnosis_document(const DiagnosisReport& report);

/// The section of one finding. @param place  its place in the diagnosis
ReportSection finding_section(const DiagnosisReport& report, std::size_t place);

/// "velocity of joint 2 [rad/s]" of "qd2"
std::string variable_label(const DiagnosisReport& report, const std::string& variable);

}  // namespace dyngen::runtime
