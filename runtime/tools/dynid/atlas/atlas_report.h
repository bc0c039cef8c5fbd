// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/effects/absorption.h"
#include "runtime/plots/figure.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// All that dynid atlas found.
struct AtlasReport {
  DescribedRobot robot;
  std::string motion;          ///< "2 recordings, 40.0 s", "trajectory sines.csv, 20.0 s"
  std::string noise_from;      ///< a sentence
  Eigen::VectorXd noise;       ///< (n) deviation, N m or N
  Eigen::Index equations = 0;  ///< of each joint
  double row_time = 0;         ///< s between them
  Eigen::VectorXd posture;     ///< (n) rad or m, in the middle of the motion
  AbsorptionAtlas atlas;
  std::vector<std::string> units;  ///< of the detectable size of each entry
  std::vector<std::size_t> order;  ///< places of entries: by joint, then by the part absorbed
};

constexpr double kLeastLikeness = 0.1;  ///< what is less is no alias

/// Joint of an entry in the robot file; 0 of the whole robot.
int atlas_joint(const AtlasReport& report, std::size_t entry);

std::string atlas_table(const AtlasReport& report);
/// Schema dynid.atlas/1, docs/explanation/atlas.md.
std::string atlas_json(const AtlasReport& report);
/// How alike effects are after the projection; those that are all absorbed are left out.
HeatMap atlas_picture(const AtlasReport& report);
/// The page. @param command  as it was called
ReportDocument atlas_document(const AtlasReport& report, const std::string& command);

}  // namespace dyngen::runtime
