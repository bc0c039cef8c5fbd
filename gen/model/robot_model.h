// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gen/model/chi.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

enum class JointType { kRevolute = 0, kPrismatic = 1, kFixed = 2 };

/// A quantity of the robot: an exact number, or unknown (a symbol at run time).
struct Quantity {
  bool unknown = false;
  GiNaC::ex value = 0;  ///< exact; 0 where unknown
  int line = 0;         ///< of the robot file or its source; 0 where the row is absent
  bool open = false;    ///< a number that estimation may change: a 0 among them is no structure

  [[nodiscard]] bool known_zero() const { return !unknown && !open && value.is_zero(); }
};

/// One row of the DH table and the link that hangs on it, as the file gives them.
struct JointModel {
  JointType type = JointType::kRevolute;
  int parent = 0;       ///< 1-based, 0 is the base
  GiNaC::ex alpha = 0;  ///< rad
  GiNaC::ex theta = 0;  ///< rad, added to q of a revolute joint
  Quantity d;           ///< m
  Quantity r;           ///< m, added to q of a prismatic joint
  std::array<Quantity, kChiCount> chi;
  std::optional<GiNaC::ex> qmin, qmax;  ///< rad or m; none: no limit
  std::string name;
  int coordinate = -1;  ///< its place in q, dq, ddq, tau; -1 for a fixed joint
};

/// A robot that has been checked: joints in file order, parents before children.
struct RobotModel {
  std::string name;       ///< a C identifier
  std::string file_name;  ///< as the user gave it
  std::string text;       ///< of the description, for messages about what its effects mean
  DhConvention convention = DhConvention::kModified;
  ParameterMeaning parameters = ParameterMeaning::kBodies;
  std::vector<JointModel> joints;   ///< joints[j - 1] is joint j
  std::array<Quantity, 3> gravity;  ///< acceleration of the base, -g, m/s^2, in frame 0
  std::vector<EffectRow> effects;
  int coordinate_count = 0;  ///< moving joints

  [[nodiscard]] int size() const { return static_cast<int>(joints.size()); }
  [[nodiscard]] const JointModel& joint(int j) const {
    return joints[static_cast<std::size_t>(j - 1)];
  }
};

/// Builds the model of a file that was checked when it was read.
RobotModel build_model(const RobotFile& file);

}  // namespace dyngen
