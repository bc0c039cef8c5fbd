// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace dyngen::test {

/// Path of a file among the real recordings, which are not part of this project: in the folder
/// DYNGEN_SHARED_DATA (an environment variable), else in ../shared/data beside the project. Nothing
/// if it is not there; a test then says skip_sentence() and skips.
std::optional<std::string> shared_data(const std::string& name);

/// "tx40/tx40.csv is not here; ..."
std::string skip_sentence(const std::string& name);

}  // namespace dyngen::test
