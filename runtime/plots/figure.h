// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace dyngen::runtime {

enum class SeriesStyle {
  kLine,
  kPoints,  ///< small marks, half transparent
  kBand,    ///< the area between y and high
  kBars     ///< from 0
};

/// A curve of a panel.
struct Series {
  std::string name;  ///< in the key; empty: not there
  Eigen::VectorXd x, y;
  bool dashed = false;
  int colour = -1;  ///< place among the colours, from 0; negative: the series' own place
  SeriesStyle style = SeriesStyle::kLine;
  Eigen::VectorXd high{};  ///< of a band
};

/// A diagram with its own axes.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<double> levels;  ///< horizontal dotted lines: limits
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<std::string> x_names{};  ///< that stand at x = 0, 1 ...; empty: numbers
};

/// Panels in rows, from the upper left.
struct Figure {
  std::string title;
  int columns = 1;
  int panel_width = 640, panel_height = 240;  ///< pixels
  std::vector<Panel> panels;

  /// @throws std::invalid_argument  if there is no panel, a size is not positive, or x, y and
  /// high of a series differ in length
  void validate() const;
};

/// A square table as colours: how alike things are.
struct HeatMap {
  std::string title;
  std::vector<std::string> names;  ///< of rows and columns
  Eigen::MatrixXd values;          ///< (names x names), 0 to 1

  /// @throws std::invalid_argument  if there is no name or the table has another size
  void validate() const;
};

/// A picture could not be drawn; what() says why.
class FigureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether pictures can be drawn here: gnuplot is installed.
bool can_draw();

/// Draws a figure with gnuplot into a .svg or .png file, which appears when it is complete.
///
/// Lines of more than 1400 points are thinned to what the eye can see: the least and the
/// largest value of every slice are kept.
/// @throws FigureError  without gnuplot, for another ending, or if the file cannot be written
/// @throws std::invalid_argument  as validate()
void draw(const Figure& figure, const std::string& path);
void draw(const HeatMap& map, const std::string& path);

/// The script and the data that gnuplot is given; the same text for the same figure.
/// @param terminal  of gnuplot: "svg", "pngcairo"
std::string gnuplot_script(const Figure& figure, const std::string& terminal,
                           const std::string& output);
std::string gnuplot_script(const HeatMap& map, const std::string& terminal,
                           const std::string& output);

}  // namespace dyngen::runtime
