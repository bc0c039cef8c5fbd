// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::test {

/// A temporary copy of a robot file without the rows of these keywords: what is absent is zero.
/// @param path_in_project  "robots/planar2r.robot"      @return its path
std::string file_without(const std::string& path_in_project,
                         const std::vector<std::string>& keywords);

}  // namespace dyngen::test
