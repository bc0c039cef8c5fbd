// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/drawing/view.h"

namespace dyngen {

/// From space to the pixels of a picture, y downwards.
struct Paper {
  Viewpoint view;
  double scale = 1;  ///< px per m
  Point origin;      ///< where frame 0 stands, px

  [[nodiscard]] Point at(const Vec3& place) const {
    const Point point = view.project(place);
    return {origin.x + scale * point.x, origin.y - scale * point.y};
  }
};

}  // namespace dyngen
