// SPDX-License-Identifier: MIT
#include "tests/support/shared_data.h"

#include <cstdlib>
#include <filesystem>

namespace dyngen::test {

std::optional<std::string> shared_data(const std::string& name) {
  const char* given = std::getenv("DYNGEN_SHARED_DATA");
  const std::filesystem::path folder =
      given != nullptr && *given != '\0'
          ? std::filesystem::path(given)
          : std::filesystem::path(DYNGEN_SOURCE_DIR).parent_path() / "shared" / "data";
  std::error_code ignored;
  if (!std::filesystem::exists(folder / name, ignored)) return std::nullopt;
  return (folder / name).string();
}

std::string skip_sentence(const std::string& name) {
  return name + " is not here; set DYNGEN_SHARED_DATA to the folder of real recordings";
}

}  // namespace dyngen::test
