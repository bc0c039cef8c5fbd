// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/tools/dynid/robot/identified_description.h"
#include "tests/gen/robot_input/description_text.h"

/// Identified numbers on their way into a description.
namespace dyngen::test {

/// The same arm with other masses, centres, moments and friction.
std::vector<MadeLink> with_other_bodies(std::vector<MadeLink> links, unsigned seed);

/// What dynid writes of the arm if its base parameters are found exactly: a robot file.
std::string identified_base_parameters(const std::vector<MadeLink>& links);

/// Writes a file. @return  its path
std::string written(const std::string& path, const std::string& text);

/// The description of a path with the numbers of an identified robot file.
runtime::IdentifiedDescription into(const std::string& path, const std::string& identified);

}  // namespace dyngen::test
