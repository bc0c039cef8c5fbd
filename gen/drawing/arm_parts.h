// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/posture/posture.h"

namespace dyngen {

/// What a drawing of an arm consists of, in space (m, frame 0).
struct ArmParts {
  /// A straight piece of a link.
  struct Rod {
    Vec3 from, to;
    int link = 0;
    bool open = false;  ///< the link goes on, the file does not say how far
  };
  /// The cylinder, box or plate of a joint, somewhere on its axis.
  struct Body {
    int joint = 0;
    Vec3 centre;
  };
  /// Axes of frames with a common origin that point the same way.
  struct Arrow {
    Vec3 from, direction;
    char axis = 'x';
    std::vector<int> frames;
  };
  /// Where the base is fixed.
  struct Ground {
    Vec3 centre, normal;
  };
  double size = 1;  ///< the arm's extent; other sizes are shares of it
  std::vector<Rod> rods;
  std::vector<Body> bodies;  ///< in the order of the joints
  std::vector<Arrow> arrows;
  std::vector<Vec3> tools;  ///< ends of links that no other link hangs on
  Ground ground;

  [[nodiscard]] double body_length() const { return 0.085 * size; }  ///< along its axis
  [[nodiscard]] double body_radius() const { return 0.03 * size; }
  /// Of a frame's axis: z is longest, so that all show where several point the same way.
  [[nodiscard]] double arrow_length(char axis) const {
    return (axis == 'z' ? 0.17 : axis == 'x' ? 0.14 : 0.1) * size;
  }
};

/// @param up  unit vector against gravity
ArmParts arm_parts(const Posture& posture, const Vec3& up);

}  // namespace dyngen
