// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::runtime {

/// Text as it may stand in an element or in an attribute. Control characters become spaces.
std::string html_text(const std::string& text);

/// "<p>...</p>" of plain text.
std::string html_paragraph(const std::string& text);

/// A list of plain lines; nothing where there are none.
std::string html_list(const std::vector<std::string>& lines);

/// A cell of a table: plain text, or markup that is made here.
struct HtmlCell {
  std::string markup;
  bool number = false;  ///< stands on the right

  static HtmlCell text(const std::string& plain) { return {html_text(plain), false}; }
  /// Four digits; "-" where it is not finite.
  static HtmlCell of(double value);
};

/// @param rows  of as many cells as the header
std::string html_table(const std::vector<std::string>& header,
                       const std::vector<std::vector<HtmlCell>>& rows);

/// A bar of a picture.
struct HtmlBar {
  double length = 0;  ///< 0 .. 1
  std::string kind;   ///< class of its colour: "before", "after", "floor"
};
/// Bars one under the other, as inline SVG. @param label  what it shows, for who cannot see it
std::string html_bars(const std::vector<HtmlBar>& bars, const std::string& label);

/// A page that needs no other file: light and dark as the reader's screen is, and to be printed.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace dyngen::runtime
