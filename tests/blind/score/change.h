// SPDX-License-Identifier: MIT
// Real recordings to which a torque was added: how the answer changed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace blind {

struct Change {
  std::string name, recording;
  nlohmann::json added;           ///< of the manifest
  bool answered = false;          ///< both before and after
  bool before = false;            ///< it was said of the recording as it is
  bool appears = false;           ///< it is said now, by a family or an alias, and was not before
  bool first = false;             ///< by its own family
  double probability = 0;         ///< of the finding that says it
  std::string said;               ///< that finding, or what took its place
  std::vector<std::string> lost;  ///< findings that are no longer there
  std::vector<std::string> more;  ///< findings that are new and not what was added
  std::vector<std::string> open;  ///< joints with structure without a name that had none before

  /// It appears and nothing else does.
  [[nodiscard]] bool right() const { return appears && more.empty(); }
};

/// @param before, after  answers to the recording as it is, and with what was added
Change judge_change(const nlohmann::json& entry, const nlohmann::json& before,
                    const nlohmann::json& after);

/// What was said of the recordings as they are, and a row for each case; Markdown.
std::string change_table(const std::vector<Change>& all);

}  // namespace blind
