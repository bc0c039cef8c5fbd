// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/labels.h"

#include <algorithm>
#include <cmath>

namespace dyngen {
namespace {

using Box = LabelPlacer::Box;

double shared_area(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

/// How much of a line is in a box.
double shared_length(const Box& box, const Point& from, const Point& to) {
  double begin = 0, end = 1;
  const auto clip = [&](double start, double step, double low, double high) {
    if (std::abs(step) < 1e-9) {
      if (start < low || start > high) end = -1;
      return;
    }
    const double a = (low - start) / step, b = (high - start) / step;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  };
  clip(from.x, to.x - from.x, box.left, box.right);
  clip(from.y, to.y - from.y, box.top, box.bottom);
  return end > begin ? (end - begin) * length(to - from) : 0;
}

}  // namespace

void LabelPlacer::avoid(const Point& from, const Point& to, double weight) {
  lines_.push_back({from, to, weight});
}

void LabelPlacer::avoid(const Box& box, double weight) { areas_.push_back({box, weight}); }

double LabelPlacer::cost(const Box& box) const {
  const double area = (box.right - box.left) * (box.bottom - box.top);
  double sum = 40 * (area - shared_area(box, paper_));
  for (const Area& other : areas_) sum += other.weight * shared_area(box, other.box);
  for (const Line& line : lines_) sum += line.weight * shared_length(box, line.from, line.to);
  return sum;
}

Point LabelPlacer::place(const Point& anchor, const Point& towards, double width, double height) {
  constexpr int kDirections = 24;
  constexpr double kTurn = 6.283185307179586;
  Point best = anchor;
  double least = HUGE_VAL;
  Box taken;
  for (const double gap : {3.0, 9.0, 16.0, 26.0, 40.0, 56.0}) {
    for (int k = 0; k < kDirections; ++k) {
      const Point way = {std::cos(kTurn * k / kDirections), std::sin(kTurn * k / kDirections)};
      // the box touches the circle of this gap
      const Point middle = {anchor.x + way.x * (gap + 0.5 * width),
                            anchor.y + way.y * (gap + 0.5 * height)};
      const Box box = {middle.x - 0.5 * width, middle.y - 0.5 * height, middle.x + 0.5 * width,
                       middle.y + 0.5 * height};
      const double aside =
          length(towards) > 0 ? 1 - (way.x * towards.x + way.y * towards.y) / length(towards) : 0;
      const double found = cost(box) + 2.2 * gap + 16 * aside;
      if (found < least - 1e-6) {  // not by rounding
        least = found;
        best = middle;
        taken = box;
      }
    }
  }
  avoid(taken, 4);
  return best;
}

}  // namespace dyngen
