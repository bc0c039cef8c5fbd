// SPDX-License-Identifier: MIT
#include "runtime/plots/figure.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kSlices = 700;  // more than a panel has pixels

/// Colours that people tell apart who see colours differently (Okabe and Ito, 2008).
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};

/// @param place  of the series in its panel
const char* colour_of(const Series& series, std::size_t place) {
  const std::size_t chosen = series.colour < 0 ? place : static_cast<std::size_t>(series.colour);
  return kColours[chosen % std::size(kColours)];
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "\"";
}

/// Places of the least and largest value of each slice, ascending.
std::vector<Index> visible(const VectorXd& y) {
  std::vector<Index> places;
  if (y.size() <= 2 * kSlices) {
    for (Index i = 0; i < y.size(); ++i) places.push_back(i);
    return places;
  }
  for (Index slice = 0; slice < kSlices; ++slice) {
    const Index from = slice * y.size() / kSlices, to = (slice + 1) * y.size() / kSlices;
    Index least = 0, most = 0;
    y.segment(from, to - from).minCoeff(&least);
    y.segment(from, to - from).maxCoeff(&most);
    places.push_back(from + std::min(least, most));
    if (least != most) places.push_back(from + std::max(least, most));
  }
  return places;
}

/// The data of a series as gnuplot's inline data block; a gap where a value is not finite.
std::string data_block(const Series& series, const std::string& name) {
  const bool band = series.style == SeriesStyle::kBand;
  std::string text = "$" + name + " << EOD\n";
  const auto add = [&](Index i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i]) ||
        (band && !std::isfinite(series.high[i]))) {
      text += "\n";
    } else if (band) {
      text += fmt::format("{:.7g} {:.7g} {:.7g}\n", series.x[i], series.y[i], series.high[i]);
    } else {
      text += fmt::format("{:.7g} {:.7g}\n", series.x[i], series.y[i]);
    }
  };
  if (series.style == SeriesStyle::kLine) {
    for (const Index i : visible(series.y)) add(i);
  } else {
    for (Index i = 0; i < series.y.size(); ++i) add(i);
  }
  return text + "EOD\n";
}

/// How a series is drawn, as gnuplot says it. @param colour  "#rrggbb"
std::string style_text(const Series& series, const std::string& colour) {
  switch (series.style) {
    case SeriesStyle::kPoints:
      return fmt::format("using 1:2 with points pointtype 7 pointsize 0.25 linecolor rgb \"#90{}\"",
                         colour.substr(1));
    case SeriesStyle::kBand:
      return fmt::format(
          "using 1:2:3 with filledcurves fillcolor rgb \"{}\" fillstyle transparent solid 0.2 "
          "noborder",
          colour);
    case SeriesStyle::kBars:
      return fmt::format(
          "using 1:2 with boxes fillcolor rgb \"{0}\" linecolor rgb \"{0}\" fillstyle solid",
          colour);
    case SeriesStyle::kLine:
      break;
  }
  return fmt::format("using 1:2 with lines linewidth 1.5 linecolor rgb \"{}\"{}", colour,
                     series.dashed ? " dashtype 2" : "");
}

std::string panel_script(const Panel& panel, const std::string& name) {
  std::string data, plots;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    const std::string block = fmt::format("{}_{}", name, i);
    data += data_block(series, block);
    plots += fmt::format("{}${} {} {}", plots.empty() ? "" : ", \\\n  ", block,
                         style_text(series, colour_of(series, i)),
                         series.name.empty() ? "notitle" : "title " + quoted(series.name));
  }
  for (const double level : panel.levels) {
    plots +=
        fmt::format("{}{:.9g} with lines linewidth 1 dashtype 3 linecolor rgb \"#999999\" notitle",
                    plots.empty() ? "" : ", \\\n  ", level);
  }
  std::string text = data;
  text += "set title " + quoted(panel.title) + " noenhanced\n";
  text += "set xlabel " + quoted(panel.x_label) + " noenhanced\n";
  text += "set ylabel " + quoted(panel.y_label) + " noenhanced\n";
  text += panel.logarithmic_x ? "set logscale x\n" : "unset logscale x\n";
  text += panel.logarithmic_y ? "set logscale y\n" : "unset logscale y\n";
  if (plots.empty()) plots = "NaN notitle";
  if (panel.x_names.empty()) return text + "plot " + plots + "\n";
  std::string names;
  for (std::size_t i = 0; i < panel.x_names.size(); ++i) {
    names += fmt::format("{}{} {}", i > 0 ? ", " : "", quoted(panel.x_names[i]), i);
  }
  return text + "set boxwidth 0.25\nset yrange [0:*]\nset xtics noenhanced (" + names + ")\nplot " +
         plots + "\nset xtics autofreq\nset yrange [*:*]\n";
}

/// Runs gnuplot. @return whether it was found and content with its arguments
bool run_gnuplot(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "gnuplot");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &quiet, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  return failed == 0 && waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

void Figure::validate() const {
  if (panels.empty()) throw std::invalid_argument("Figure: there is no panel");
  if (columns < 1 || panel_width < 1 || panel_height < 1) {
    throw std::invalid_argument(
        fmt::format("Figure: {} columns of panels of {} x {} pixels, expected positive numbers",
                    columns, panel_width, panel_height));
  }
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      const bool whole =
          series.style != SeriesStyle::kBand || series.high.size() == series.y.size();
      if (series.x.size() == series.y.size() && whole) continue;
      throw std::invalid_argument(
          fmt::format("Figure: series '{}' has {} values of x, {} of y and {} of its band",
                      series.name, series.x.size(), series.y.size(), series.high.size()));
    }
  }
}

std::string gnuplot_script(const Figure& figure, const std::string& terminal,
                           const std::string& output) {
  figure.validate();
  const int rows = (static_cast<int>(figure.panels.size()) + figure.columns - 1) / figure.columns;
  std::string text =
      fmt::format("set terminal {} size {},{} font \"sans,11\" background rgb \"white\"\n",
                  terminal, figure.columns * figure.panel_width,
                  rows * figure.panel_height + (figure.title.empty() ? 0 : 30));
  text += "set output " + quoted(output) + "\n";
  text += "set grid linecolor rgb \"#dddddd\"\nset tics nomirror\nset border 3\n";
  text += "set key outside right top noenhanced\n";
  text += fmt::format("set multiplot layout {},{}", rows, figure.columns);
  if (!figure.title.empty()) text += " title " + quoted(figure.title) + " noenhanced";
  text += "\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    text += panel_script(figure.panels[i], fmt::format("panel{}", i));
  }
  return text + "unset multiplot\nset output\n";
}

void HeatMap::validate() const {
  const Index count = static_cast<Index>(names.size());
  if (count > 0 && values.rows() == count && values.cols() == count) return;
  throw std::invalid_argument(
      fmt::format("HeatMap: {} names and a table of {} x {}", count, values.rows(), values.cols()));
}

std::string gnuplot_script(const HeatMap& map, const std::string& terminal,
                           const std::string& output) {
  map.validate();
  constexpr int kCell = 13, kNames = 230;  // pixels
  const int side = kCell * static_cast<int>(map.names.size());
  std::string text =
      fmt::format("set terminal {} size {},{} font \"sans,8\" background rgb \"white\"\n", terminal,
                  side + kNames + 90, side + kNames + 40);
  text += "set output " + quoted(output) + "\n$table << EOD\n";
  for (Index i = 0; i < map.values.rows(); ++i) {
    for (Index k = 0; k < map.values.cols(); ++k) {
      text += fmt::format("{}{:.3f}", k > 0 ? " " : "", map.values(i, k));
    }
    text += "\n";
  }
  text += "EOD\nset title " + quoted(map.title) + " noenhanced\nunset key\nset tics out nomirror\n";
  std::string tics;
  for (std::size_t i = 0; i < map.names.size(); ++i) {
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", quoted(map.names[i]), i);
  }
  text += "set xtics rotate by 90 right noenhanced (" + tics + ")\n";
  text += "set ytics noenhanced (" + tics + ")\n";
  // one colour that grows darker: readable without colours too
  text +=
      "set palette defined (0 \"#ffffff\", 0.5 \"#7fb2d8\", 0.9 \"#0072b2\", 1 \"#00263b\")\n"
      "set cbrange [0:1]\n";
  text += fmt::format("set xrange [-0.5:{0}.5]\nset yrange [{0}.5:-0.5]\n", map.names.size() - 1);
  return text + "plot $table matrix with image\nset output\n";
}

namespace {

/// Draws what a script says into a file that appears when it is complete.
/// @param script_of  of the terminal and the file to write
void draw_script(const std::string& path,
                 const std::function<std::string(const std::string& terminal,
                                                 const std::string& part)>& script_of) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".svg" && ending != ".png") {
    throw FigureError(
        fmt::format("{}: found the ending '{}', expected .svg or .png", path, ending));
  }
  if (!can_draw()) {
    throw FigureError(path +
                      ": pictures are drawn by gnuplot, which is not installed "
                      "(Debian: gnuplot-nox)");
  }
  const std::string part = fmt::format("{}.{}.part", path, getpid());
  const std::string script = part + ".gnuplot";
  std::ofstream(script) << script_of(ending == ".svg" ? "svg dynamic" : "pngcairo", part);
  const bool drawn = run_gnuplot({script});
  std::error_code error;
  std::filesystem::remove(script, error);
  const auto bytes = std::filesystem::file_size(part, error);
  if (drawn && !error && bytes > 0) {
    std::filesystem::rename(part, path, error);
    if (!error) return;
  }
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw FigureError(fmt::format("{}: cannot be written", path));
}

}  // namespace

bool can_draw() {
  static const bool found = run_gnuplot({"--version"});
  return found;
}

void draw(const Figure& figure, const std::string& path) {
  figure.validate();
  draw_script(path, [&](const std::string& terminal, const std::string& part) {
    return gnuplot_script(figure, terminal, part);
  });
}

void draw(const HeatMap& map, const std::string& path) {
  map.validate();
  draw_script(path, [&](const std::string& terminal, const std::string& part) {
    return gnuplot_script(map, terminal, part);
  });
}

}  // namespace dyngen::runtime
