// SPDX-License-Identifier: MIT
#include "runtime/plots/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;
using testing::Not;

std::string content(const std::string& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::ptrdiff_t lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

Figure sine(Eigen::Index samples) {
  Series series{"q1 \"measured\"", VectorXd::LinSpaced(samples, 0, 1), {}, false};
  series.y = (6.28 * series.x.array()).sin();
  Panel panel{"joint 1", "time, s", "position, rad", {series}, {1.5, -1.5}, false, false};
  Panel log{"condition", "start", "",  {{"", series.x, series.y.cwiseAbs2(), true}},
            {},          false,   true};
  return {"a sine", 2, 320, 200, {panel, log}};
}

TEST(Figure, IsDrawnWithItsWords) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string path = test::temporary_path("sine.svg");
  draw(sine(200), path);
  const std::string svg = content(path);
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("position, rad"));
  EXPECT_THAT(svg, HasSubstr("measured"));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::remove(path);
}

TEST(Figure, LeavesNothingBehindWhereItCannotWrite) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string folder = test::temporary_path("missing_folder");
  EXPECT_THROW(draw(sine(20), folder + "/sine.svg"), FigureError);
  EXPECT_FALSE(std::filesystem::exists(folder));
  EXPECT_THROW(draw(sine(20), test::temporary_path("sine.gif")), FigureError);
}

TEST(Figure, ThinsLongCurvesAndKeepsTheirPeaks) {
  Figure figure = sine(1000000);
  figure.panels.resize(1);
  figure.panels[0].series[0].y[123456] = 77;  // one sample
  const std::string script = gnuplot_script(figure, "svg", "x.svg");
  EXPECT_LT(lines_of(script), 1500);
  EXPECT_THAT(script, HasSubstr(" 77\n"));
}

TEST(Figure, LeavesAGapWhereThereIsNoValue) {
  Figure figure = sine(3);
  figure.panels.resize(1);
  figure.panels[0].series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  const std::string script = gnuplot_script(figure, "svg", "x.svg");
  EXPECT_THAT(script, Not(HasSubstr("nan")));
  EXPECT_THAT(script, HasSubstr("\n\n"));
}

TEST(Figure, RefusesWhatDoesNotFit) {
  Figure figure = sine(10);
  figure.panels[0].series[0].x.resize(9);
  EXPECT_THROW(figure.validate(), std::invalid_argument);
  EXPECT_THROW(Figure().validate(), std::invalid_argument);
  figure = sine(10);
  figure.columns = 0;
  EXPECT_THROW(figure.validate(), std::invalid_argument);
}

TEST(HeatMap, IsDrawnWithItsNames) {
  HeatMap map{"alike", {"stribeck 1", "dahl \"2\""}, Eigen::Matrix2d::Identity()};
  const std::string script = gnuplot_script(map, "svg", "x.svg");
  EXPECT_THAT(script, HasSubstr("\"stribeck 1\" 0, \"dahl \\\"2\\\"\" 1"));
  EXPECT_THAT(script, HasSubstr("1.000 0.000\n0.000 1.000\n"));
  map.names.pop_back();
  EXPECT_THROW(map.validate(), std::invalid_argument);
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  map.names.emplace_back("dahl 2");
  const std::string path = test::temporary_path("map.svg");
  draw(map, path);
  EXPECT_THAT(content(path), HasSubstr("dahl 2"));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace dyngen::runtime
