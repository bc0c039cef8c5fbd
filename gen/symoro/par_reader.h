// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// Whether a text is SYMORO's: it begins with a comment (* *) or an assignment NAME = ...
bool is_symoro_text(std::string_view text);

/// Reads SYMORO's .par: ant sigma b d gamma r alpha mu theta, the inertial rows, IA FV FS, G.
///
/// Frames are modified DH ones (Khalil and Kleinfinger 1986): T = Rz(gamma) Tz(b) Rx(alpha) Tx(d)
/// Rz(theta) Tz(r). gamma and b become a fixed row in front. A symbol in a row that may be unknown
/// becomes '*'; the joint variable in theta (of a sliding joint: in r) becomes 0. G is the
/// acceleration of gravity, so the robot file has its negative.
///
/// @throws ModelError  positioned: closed loops, mobile and floating bases by name; symbols where a
///         robot file needs numbers; lists of a wrong length; unknown names
MadeText read_par(std::string text, const std::string& file_name);

}  // namespace dyngen
