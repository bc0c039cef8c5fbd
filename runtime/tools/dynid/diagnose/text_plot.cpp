// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/text_plot.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace dyngen::runtime {
namespace {

// by what part of a cell is filled, from an eighth on
constexpr const char* kAcross[] = {"▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};
constexpr const char* kUp[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr const char* kPlain[] = {"_", ".", "-", "=", "+", "*", "#", "@"};

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

bool has_utf8_locale() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const std::string_view value = variable(name);
    if (value.empty()) continue;
    return value.find("UTF-8") != value.npos || value.find("utf8") != value.npos ||
           value.find("utf-8") != value.npos;
  }
  return false;
}

}  // namespace

TextStyle style_of_output() {
  TextStyle style;
  style.colour = isatty(STDOUT_FILENO) == 1 && variable("NO_COLOR").empty() &&
                 variable("TERM") != "dumb" && !variable("TERM").empty();
  style.blocks = has_utf8_locale();
  return style;
}

std::string text_bar(double part, int width, const TextStyle& style) {
  std::string bar;
  if (!std::isfinite(part)) return std::string(static_cast<std::size_t>(width), ' ');
  const int eighths = static_cast<int>(std::lround(8 * width * std::clamp(part, 0.0, 1.0)));
  int used = eighths / 8;
  if (style.blocks) {
    for (int i = 0; i < used; ++i) bar += kAcross[7];
    if (eighths % 8 != 0) {
      bar += kAcross[eighths % 8 - 1];
      ++used;
    }
  } else {
    used = (eighths + 4) / 8;
    bar.assign(static_cast<std::size_t>(used), '#');
  }
  return bar + std::string(static_cast<std::size_t>(std::max(0, width - used)), ' ');
}

std::string sparkline(const std::vector<double>& values, const TextStyle& style) {
  double least = INFINITY, most = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  std::string line;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      line += ' ';
      continue;
    }
    const double part = most > least ? (value - least) / (most - least) : 0;
    const auto level = static_cast<std::size_t>(std::min(7.0, std::floor(8 * part)));
    line += style.blocks ? kUp[level] : kPlain[level];
  }
  return line;
}

std::string coloured(const std::string& text, TextColour colour, const TextStyle& style) {
  if (!style.colour || text.empty()) return text;
  const char* code = colour == TextColour::kBefore  ? "33"  // yellow
                     : colour == TextColour::kAfter ? "34"  // blue
                     : colour == TextColour::kFloor ? "90"  // grey
                                                    : "1";  // bold
  return std::string("\x1b[") + code + "m" + text + "\x1b[0m";
}

}  // namespace dyngen::runtime
