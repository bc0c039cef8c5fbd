// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::runtime {

/// What a terminal shows.
struct TextStyle {
  bool colour = false;
  bool blocks = false;  ///< block characters; else ASCII alone
};

/// The style of standard output: colours only on a terminal that can show them and where NO_COLOR
/// is not set; block characters where the locale is UTF-8.
TextStyle style_of_output();

/// A bar of a part of a width in characters. @param part  0 to 1; NaN: none
std::string text_bar(double part, int width, const TextStyle& style);

/// A character for each value, as high as it is between the least and the largest; a blank where it
/// is not finite.
std::string sparkline(const std::vector<double>& values, const TextStyle& style);

enum class TextColour { kBefore, kAfter, kFloor, kMark };
/// The text in a colour, where there are colours.
std::string coloured(const std::string& text, TextColour colour, const TextStyle& style);

}  // namespace dyngen::runtime
