// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gen/drawing/view.h"

/// Pieces of SVG text. Points are on the paper in pixels, y downwards; numbers have one decimal.
namespace dyngen::svg {

/// Text as XML wants it.
std::string escape(std::string_view text);

std::string line(const Point& from, const Point& to, std::string_view colour, double width,
                 std::string_view dashes = {});
std::string polygon(const std::vector<Point>& corners, std::string_view fill,
                    std::string_view stroke);
/// @param turn  of the first half axis, rad, clockwise
std::string ellipse(const Point& centre, double a, double b, double turn, std::string_view fill,
                    std::string_view stroke);
/// A line with a head at its end, on a white edge.
std::string arrow(const Point& from, const Point& to, std::string_view colour, double width);

struct TextStyle {
  double size = 12;
  std::string_view colour = "#24292f";
  std::string_view anchor = "middle";  ///< start, middle, end
  bool bold = false;
};
/// Words on a white edge. @param place  of their base line
std::string words(const Point& place, std::string_view text, const TextStyle& style);
/// About how wide words are.
double width_of(std::string_view text, double size);

/// A whole file on white paper.
std::string file(double width, double height, std::string_view title, std::string_view description,
                 const std::string& content);

}  // namespace dyngen::svg
