// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/code_model/link_form.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// A symmetric tensor: XX XY XZ YY YZ ZZ.
using Tensor = std::array<GiNaC::ex, 6>;
enum TensorEntry : std::size_t { kXX, kXY, kXZ, kYY, kYZ, kZZ };

/// Inertial parameters of a link in one of its views.
struct LinkInertia {
  bool euler_tensor = false;
  Tensor tensor;  ///< J, or K = tr(J)/2 I - J (kg m^2)
  Vector3 MS;     ///< first moments (kg m)
  GiNaC::ex M;    ///< mass (kg)
};

/// How far each origin is moved along its joint axis, in m; element 0 is the base.
std::vector<GiNaC::ex> origin_shifts(const CodeModel& code, const RneaForm& form);

/// The parameters of each link for its form, in the link's own frame; element 0 is the base, and
/// empty. The statements hold parameters and constants only.
///
/// A body that turns about z does not show Kzz: on a revolute link it stands for a body with
/// XX = YY = Kzz and nothing else, which moves to the parent as K = Kzz z z^T (the freedom of base
/// parameters; Gautier and Khalil 1990 use it to make YY = 0 instead).
std::vector<LinkInertia> write_inertia(Trace& trace, const CodeModel& code, const RneaForm& form,
                                       const std::vector<GiNaC::ex>& shifts);

/// The same in the axis frame: turned by the angle of the rotation about z.
LinkInertia turned(Trace& trace, int link, const LinkInertia& inertia,
                   const FrameRotation& rotation);

}  // namespace dyngen
