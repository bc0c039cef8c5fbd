// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/svg.h"

#include <fmt/format.h>

#include <cmath>

namespace dyngen::svg {
namespace {

/// One decimal, and no negative zero.
std::string number(double value) {
  const double rounded = std::round(10 * value) / 10;
  return fmt::format("{:.10g}", rounded == 0 ? 0.0 : rounded);
}

std::string pair(const Point& point) { return number(point.x) + "," + number(point.y); }

}  // namespace

std::string escape(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string line(const Point& from, const Point& to, std::string_view colour, double width,
                 std::string_view dashes) {
  const std::string pattern = dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes);
  return fmt::format(
      "<path d=\"M{} L{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-linecap=\"{}\"{}/>\n",
      pair(from), pair(to), colour, number(width), dashes.empty() ? "round" : "butt", pattern);
}

std::string polygon(const std::vector<Point>& corners, std::string_view fill,
                    std::string_view stroke) {
  std::string points;
  for (const Point& corner : corners) points += (points.empty() ? "" : " ") + pair(corner);
  return fmt::format(
      "<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-linejoin=\"round\"/>\n", points,
      fill, stroke);
}

std::string ellipse(const Point& centre, double a, double b, double turn, std::string_view fill,
                    std::string_view stroke) {
  constexpr double kDegrees = 57.29577951308232;
  return fmt::format(
      "<ellipse rx=\"{}\" ry=\"{}\" transform=\"translate({}) rotate({})\" fill=\"{}\" "
      "stroke=\"{}\"/>\n",
      number(a), number(b), pair(centre), number(turn * kDegrees), fill, stroke);
}

std::string arrow(const Point& from, const Point& to, std::string_view colour, double width) {
  const double whole = length(to - from);
  if (whole < 1) return "";
  const Point way = (1 / whole) * (to - from), side = {-way.y, way.x};
  const double head = std::min(9.0, 0.6 * whole);
  const Point neck = to - head * way;
  return line(from, neck, "#ffffff", width + 2.4) + line(from, neck, colour, width) +
         polygon({to, neck + 0.42 * head * side, neck - 0.42 * head * side}, colour, "#ffffff");
}

std::string words(const Point& place, std::string_view text, const TextStyle& style) {
  return fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{} fill=\"{}\" "
      "stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
      number(place.x), number(place.y), number(style.size), style.anchor,
      style.bold ? " font-weight=\"bold\"" : "", style.colour, escape(text));
}

double width_of(std::string_view text, double size) {
  return 0.6 * size * static_cast<double>(text.size());
}

std::string file(double width, double height, std::string_view title, std::string_view description,
                 const std::string& content) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
             "height=\"{1}\" role=\"img\" font-family=\"DejaVu Sans, Helvetica, Arial, "
             "sans-serif\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
             "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
             number(width), number(height), escape(title), escape(description)) +
         content + "</svg>\n";
}

}  // namespace dyngen::svg
