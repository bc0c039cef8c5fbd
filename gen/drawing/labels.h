// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/drawing/view.h"

namespace dyngen {

/// Finds places for words on the paper where they hide little. Units are those of the paper, y
/// downwards.
class LabelPlacer {
 public:
  struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
  };

  /// @param paper  nothing is placed outside of it
  explicit LabelPlacer(const Box& paper) : paper_(paper) {}

  /// What words should not stand on. @param weight  how bad it is
  void avoid(const Point& from, const Point& to, double weight);
  void avoid(const Box& box, double weight);

  /// The best place near a point; it is taken from then on.
  /// @param towards  preferred direction from the point; zero: any
  /// @return the middle of the words
  Point place(const Point& anchor, const Point& towards, double width, double height);

 private:
  struct Line {
    Point from, to;
    double weight;
  };
  struct Area {
    Box box;
    double weight;
  };
  [[nodiscard]] double cost(const Box& box) const;

  Box paper_;
  std::vector<Line> lines_;
  std::vector<Area> areas_;
};

}  // namespace dyngen
