// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>

#include "gen/bodies/converted_robot.h"
#include "gen/robot_file/robot_file.h"
#include "gen/robot_input/robot_source.h"
#include "gen/xml/xml_document.h"

namespace dyngen {

/// The forms in which robots are described.
enum class RobotForm {
  kRobotFile,  ///< rows of a DH table
  kUrdf,       ///< XML with the root <robot>
  kMjcf,       ///< XML with the root <mujoco>
  kSymoro,     ///< assignments of SYMORO's .par
  kOtherXml
};

/// What a text is, by its content alone.
RobotForm robot_form(std::string_view text);

/// Reads a robot in any form.
/// @throws ModelError  if the file cannot be read, what it says is wrong or not supported, or
///         --base, --tip and --round-angles are given for a form that has no links: up to 20
///         positioned messages
RobotFile read_robot_file(const RobotSource& source, const FurtherCheck& further = {});

/// The same of a text that was read. @param source  its path is used for messages alone
RobotFile parse_robot(std::string text, const RobotSource& source,
                      const FurtherCheck& further = {});

/// A robot that was made of a URDF or MJCF, with the document that it was made of: for those who
/// write numbers back into it.
struct DescribedBodies {
  XmlDocument document;
  RobotForm form = RobotForm::kUrdf;
  ConvertedRobot robot;
  std::vector<Diagnostic> warnings;  ///< of the description and its conversion
};

/// @param text  URDF or MJCF
/// @throws ModelError
DescribedBodies read_bodies(std::string text, const RobotSource& source);

}  // namespace dyngen
