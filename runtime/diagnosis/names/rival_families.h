// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// Another effect in a winner's place.
struct Rival {
  std::string family, name;
  double distance = 0;  ///< by which its chi-square reduction is smaller, net of penalties
  double apart =
      0;  ///< part of the winner's chi-square that it cannot imitate: the expected distance
  std::size_t hypothesis = 0;
  TrialScore trial;
  double selected = 0;  ///< share of the halves of the recordings in which it explains most
};

/// What is another family at some parameters has to explain more than that one: else its further
/// parameters are worth nothing.
/// @param rivals  distance is what they explain, net   @param family, net  the winner's
void drop_what_adds_nothing(std::vector<Rival>& rivals, const std::vector<Hypothesis>& hypotheses,
                            const std::string& family, double net);

/// The rival of each family that explains most, net; apart is the least of any of the family: one
/// that costs too much to be the name keeps the family possible all the same.
/// @param rivals  distance is what they explain, net
std::map<std::string, Rival> best_of_families(std::vector<Rival> rivals);

}  // namespace dyngen::runtime
