// SPDX-License-Identifier: MIT
// Physics that the model leaves out. Each has a form and a family name; most forms differ from
// those of gen/effects, so that no one finds only what he has put in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/blind/simulation/machine.h"

namespace blind {

/// One effect of one machine; its size is not chosen yet.
struct Truth {
  std::string family;                     ///< as in findings; for physics of no family: "unknown"
  std::string form;                       ///< what acts, in words
  int joint = 0;                          ///< from 1; 0: the whole robot
  int other = 0;                          ///< the second joint, or 0
  bool own_form = true;                   ///< differs from the form of gen/effects
  double typical = 1;                     ///< a size to begin with
  double least = 0, most = 1e9;           ///< beyond, it would be something else
  std::map<std::string, double> numbers;  ///< besides the size
  /// What findings of this family call the same quantities, SI; empty: nothing that can be
  /// compared. Of other forms than the catalogue's: the same to first order.
  std::function<std::map<std::string, double>(double size)> parameters;
  std::string formula;  ///< of the finding, where names do not tell the family's members apart

  std::function<void(double size, Tree& tree)> tree;              ///< empty: nothing
  std::function<void(double size, int run, Plant& plant)> plant;  ///< run: recording, from 0
  std::function<void(double size, int run, Log& log)> log;        ///< what only the record shows
};

/// A way to draw a Truth for a joint (from 0) of a machine.
struct Physics {
  std::string family;
  std::function<bool(const Machine& machine, Eigen::Index joint)> possible;  ///< empty: always
  std::function<Truth(const Machine& machine, Eigen::Index joint, Random random)> draw;
};

/// When recordings are, for what begins or drifts.
struct Schedule {
  double duration = 20;  ///< of a training recording, s
  int runs = 3;          ///< training recordings; further ones are held out
};

std::vector<Physics> friction_physics(const Schedule& schedule);
std::vector<Physics> drive_physics(const Schedule& schedule);
std::vector<Physics> sensor_physics(const Schedule& schedule);
std::vector<Physics> structure_physics(const Schedule& schedule);
/// What happens for a time only.
std::vector<Physics> passing_physics(const Schedule& schedule);
/// What no recording of this kind shows: other parameters do the same.
std::vector<Physics> hidden_physics();
/// What the catalogue does not hold.
std::vector<Physics> foreign_physics(const Schedule& schedule);

}  // namespace blind
