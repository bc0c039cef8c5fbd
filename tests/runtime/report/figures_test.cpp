// SPDX-License-Identifier: MIT
#include "runtime/report/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

ReportDocument document() {
  ReportPanel panel;
  panel.x_label = "velocity [rad/s]";
  panel.y_label = "torque [N m]";
  panel.x = Vector3d(0, 1, 2);
  panel.series = {
      {"effect", Role::kModel, Vector3d(1, NAN, 3), Vector3d(0, 0, 0), Vector3d(2, 2, 4)}};
  panel.clouds = {{"", Role::kData, Vector2d(0.5, 1.5), Vector2d(0.25, 0.75)}};
  ReportBars bars{"rms", "held out", "", {}};
  for (const char* joint : {"joint 1", "joint 2"}) {
    bars.groups.push_back(
        {joint, "N m", false, {{"alone", Role::kBefore, 2}, {"noise", Role::kFloor, NAN}}});
  }
  ReportDocument document;
  document.sections = {{"one", "One", ReportSection::Kind::kPlain, {}}};
  document.sections[0].parts = {{"", "", "", {bars}}};
  document.sections[0].parts[0].blocks.emplace_back(
      ReportChart{"model", "a \"model\"", "", {{"qd1", {panel}}, {"q1", {panel}}}});
  return document;
}

TEST(ReportFigures, HaveEveryNumberInTheirTables) {
  const std::vector<ReportFigure> figures = report_figures(document());
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].name, "rms");
  EXPECT_EQ(
      figures[0].csv,
      "group,unit,bar,value\n\"joint 1\",\"N m\",\"alone\",2\n\"joint 1\",\"N m\",\"noise\",\n"
      "\"joint 2\",\"N m\",\"alone\",2\n\"joint 2\",\"N m\",\"noise\",\n");
  EXPECT_EQ(figures[1].name, "model");
  EXPECT_THAT(figures[1].csv, HasSubstr("view,panel,series,x,y,low,high\n\"qd1\",\"torque [N m]\","
                                        "\"effect\",0,1,0,2\n"));
  EXPECT_THAT(figures[1].csv, HasSubstr("\"effect\",1,,0,2\n"));
  EXPECT_THAT(figures[1].csv, HasSubstr("\"samples data\",1.5,0.75,,\n"));
  // both views: a head, and five rows for each
  EXPECT_EQ(std::count(figures[1].csv.begin(), figures[1].csv.end(), '\n'), 11);
}

TEST(ReportFigures, OfAMatrixIsATableOfPairs) {
  ReportDocument own = document();
  Eigen::Matrix2d alike;
  alike << 1, 0.25, 0.25, 1;
  own.sections[0].parts[0].blocks.emplace_back(
      ReportMatrix{"alike", "t", "", {"stribeck 1", "dahl 1"}, alike});
  const std::vector<ReportFigure> figures = report_figures(own);
  ASSERT_EQ(figures.size(), 3u);
  EXPECT_EQ(figures[1].name, "alike");
  EXPECT_EQ(figures[1].csv,
            "row,column,value\n\"stribeck 1\",\"stribeck 1\",1\n"
            "\"dahl 1\",\"stribeck 1\",0.25\n\"dahl 1\",\"dahl 1\",1\n");
  EXPECT_EQ(std::get<HeatMap>(figures[1].picture).names[1], "dahl 1");
}

TEST(ReportFigures, AreDrawnAsGnuplotUnderstandsThem) {
  const std::vector<ReportFigure> figures = report_figures(document());
  const std::string bars = gnuplot_script(std::get<Figure>(figures[0].picture), "svg", "bars.svg");
  EXPECT_THAT(bars, HasSubstr("with boxes"));
  EXPECT_THAT(bars, HasSubstr("\"joint 2\" 1"));
  const std::string model =
      gnuplot_script(std::get<Figure>(figures[1].picture), "svg", "model.svg");
  EXPECT_THAT(model, HasSubstr("with filledcurves"));
  EXPECT_THAT(model, HasSubstr("with points"));
  EXPECT_THAT(model, HasSubstr("0 0 2\n"));  // a band has two values at an x
  EXPECT_THAT(model, HasSubstr("a \\\"model\\\""));
}

}  // namespace
}  // namespace dyngen::runtime
