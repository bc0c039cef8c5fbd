// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"

namespace dyngen {

/// A link whose joint, with the joints that it carries, has a motion that moves neither mass nor
/// rotor: the mass matrix is singular in every position, whatever the numbers are that the model
/// leaves open. 0 if there is none.
int undetermined_joint(const CodeModel& code);

}  // namespace dyngen
