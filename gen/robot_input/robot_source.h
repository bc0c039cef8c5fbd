// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <utility>

namespace dyngen {

/// Where a robot comes from: a file in any form that is read, and which part of it is the robot.
struct RobotSource {
  RobotSource() = default;
  RobotSource(std::string path_) : path(std::move(path_)) {}  // NOLINT: a path is a source
  RobotSource(const char* path_) : path(path_) {}             // NOLINT

  std::string path;         ///< robot file, URDF, MJCF or SYMORO's .par
  std::string base;         ///< link that stands still; empty: the root. URDF and MJCF alone
  std::string tip;          ///< link at the end of the chain; empty: everything on the base
  double round_angles = 0;  ///< rad: angles so near a multiple of pi/12 are that multiple

  /// Of a file beside the robot (another plant): the part is passed over in forms without links.
  bool part_if_any = false;

  /// The same part of another file. Nothing for an empty path.
  [[nodiscard]] RobotSource beside(const std::string& other) const {
    if (other.empty()) return {};
    RobotSource source = *this;
    source.path = other;
    source.part_if_any = true;
    return source;
  }
  [[nodiscard]] bool empty() const { return path.empty(); }
  bool operator==(const RobotSource&) const = default;
};

}  // namespace dyngen
