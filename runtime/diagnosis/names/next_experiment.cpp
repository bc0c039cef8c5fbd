// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/next_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "runtime/diagnosis/names/archetypes.h"

namespace dyngen::runtime {

NextExperiment next_experiment(const std::vector<Finding>& findings) {
  NextExperiment next;
  // motions are designed for effects of one state of the robot
  const auto open = std::find_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.aliases.size() > 1 && !finding.since_reference;
  });
  if (open == findings.end()) return next;
  next.joint = open->effect.joint;
  next.families = open->aliases;
  next.archetype = archetype_for(next.families).motion;
  const std::vector<std::string> others(next.families.begin() + 1, next.families.end());
  next.purpose =
      fmt::format("separate {} from {}{}", next.families.front(), fmt::join(others, " and "),
                  next.joint >= 0 ? fmt::format(" on joint {}", next.joint + 1) : "");
  return next;
}

}  // namespace dyngen::runtime
