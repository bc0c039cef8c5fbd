// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the regressor of the energy, kinetic + potential + IA dq^2 / 2 = H beta (J), as the
/// output array "H", one entry per base parameter; no accelerations are needed. The potential
/// energy is 0 for a mass in the origin of frame 0.
///
/// With W the link's angular velocity, V its origin's velocity, and G = -g in the link's frame:
///   XX: W1^2/2   XY: W1 W2   MX: (V x W)_1 + G1   M: V^2/2 + G . O,  and cyclically.
/// Source: Gautier and Khalil, the energy model (Khalil and Dombre, "Modeling, Identification and
/// Control of Robots", 2002, on the identification of dynamic parameters).
void write_energy_regressor(Trace& trace, const CodeModel& code);

/// Writes the power that is not stored as energy, FV dq^2 + FS |dq| + OFF dq = P beta (W), as the
/// output array "P": dq . tau = d(H beta)/dt + P beta.
void write_power(Trace& trace, const CodeModel& code);

}  // namespace dyngen
