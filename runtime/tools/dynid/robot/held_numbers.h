// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen::runtime {

/// Numbers of a robot file that an estimate keeps as they are.
struct HeldNumbers {
  std::vector<bool> places;        ///< (14 links) as in StandardParameters; empty: none
  std::vector<std::string> names;  ///< "MX1", in the order of places
  /// (14 links) their standard deviations, 0 where none is given; empty: none at all
  Eigen::VectorXd deviations;
  std::vector<std::string> notes;  ///< what a word named where the file has no number

  [[nodiscard]] bool any() const { return !names.empty(); }
};

/// What the words of --hold name. A word is a list of items, held is what any of them names:
///
///     all                     every number of a dynamic row
///     links=1,2  link2        the ten inertial rows of these links
///     joints=1,elbow  elbow   all dynamic rows of these joints, by number or name
///     rows=IA,Fs  MX          these rows
///     numbers=MX1,IA2  MX1    these rows, of one link each
///
/// 1-3 is a range of numbers. +-0.05 or +-5% behind an item is the standard deviation of its
/// numbers. What is `*` or absent is no number and stays open; zeros are known anyway.
/// @throws ModelError  saying what a word names that does not exist, or that none names a number
HeldNumbers held_numbers(const RobotModel& model, const std::vector<std::string>& words);

/// The words as usage texts describe them.
inline constexpr const char* kHoldForms =
    "all, links=1,2, joints=1,elbow, rows=IA,Fs, numbers=MX1,IA2";

}  // namespace dyngen::runtime
