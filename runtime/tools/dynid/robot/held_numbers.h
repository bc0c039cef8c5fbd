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

  [[nodiscard]] bool any() const { return !names.empty(); }
};

/// What the words of --hold name: `all`, `links=1,2` (inertial numbers), `joints=1,elbow` (IA, Fs,
/// Fv, off), `rows=IA,Fs`, `numbers=MX1,IA2`; several words hold what any of them names. What is
/// `*` or absent is no number and stays open; zeros are known anyway.
/// @throws ModelError  saying what a word names that does not exist, or that it names no number
HeldNumbers held_numbers(const RobotModel& model, const std::vector<std::string>& words);

/// The word as usage texts describe it.
inline constexpr const char* kHoldForms =
    "all, links=1,2, joints=1,elbow, rows=IA,Fs or numbers=MX1,IA2";

}  // namespace dyngen::runtime
