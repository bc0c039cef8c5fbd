// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/model/linear_model.h"
#include "runtime/report/document.h"

namespace dyngen::runtime {

/// Rows of long tables that are shown; the others open on request.
inline constexpr std::size_t kRowsShown = 12;

/// "joint 2" of the coordinate 1.
std::string joint_words(int joint);
/// With a capital and a full stop.
std::string sentence(std::string text);
/// A joint's value (0-based); NaN where there is none.
double entry_of(const Eigen::VectorXd& values, Eigen::Index joint);
/// Unit of a joint's torque: "N m" or "N".
std::string torque_unit(const LinearModel& model, int joint);

/// A section of one part without a heading of its own.
ReportSection section_of(const std::string& id, const std::string& title,
                         std::vector<ReportBlock> blocks);

/// The first screen: the answer in a sentence and what belongs to it, the arm, bars.
/// @param arm, bars  left out where they are empty
ReportSection first_screen(const std::string& title, const std::string& sentence,
                           std::vector<ReportBlock> further, ReportArm arm, ReportBars bars);

/// The last section: the command, and versions in a sentence.
ReportSection origin_section(const std::string& command, const std::string& words);

}  // namespace dyngen::runtime
