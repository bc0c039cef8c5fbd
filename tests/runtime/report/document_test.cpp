// SPDX-License-Identifier: MIT
#include "runtime/report/document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "runtime/report/document_json.h"
#include "runtime/report/residual_charts.h"
#include "runtime/report/thinning.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Json = nlohmann::json;

ReportChart chart(const std::string& id) {
  ReportPanel panel;
  panel.x = Vector3d(0, 1, 2);
  panel.series = {{"left", Role::kBefore, Vector3d(1, NAN, 1.0 / 3), Vector3d(0, 0, 0),
                   Vector3d(2, 2, INFINITY), false, true}};
  panel.clouds = {{"", Role::kForward, Eigen::Vector2d(0.5, 0.25), Eigen::Vector2d(3, 4)}};
  panel.spans = {{0, 1, "here"}};
  return {id, "a title", "", {{"q1", {panel}}}};
}

ReportDocument document(ReportBlock block) {
  ReportDocument document;
  document.kind = "diagnosis";
  document.title = "arm";
  document.sections = {{"one", "One", ReportSection::Kind::kPlain, {{"part", "Where", "", {}}}}};
  document.sections[0].parts[0].blocks.push_back(std::move(block));
  return document;
}

Json block_of(const ReportBlock& block) {
  return Json::parse(document_json(document(block)))["sections"][0]["parts"][0]["blocks"][0];
}

TEST(DocumentJson, HasNumbersOfFiveDigitsAndNullForWhatIsNotFinite) {
  const Json panel = block_of(chart("a"))["views"][0]["panels"][0];
  EXPECT_EQ(panel["series"][0]["y"].dump(), "[1.0,null,0.33333]");
  EXPECT_EQ(panel["series"][0]["high"].dump(), "[2.0,2.0,null]");
  EXPECT_EQ(panel["series"][0]["role"], "before");
  EXPECT_EQ(panel["clouds"][0]["x"].dump(), "[0.5,0.25]");
  EXPECT_EQ(panel["spans"][0]["label"], "here");
}

TEST(DocumentJson, SpellsEveryBlock) {
  EXPECT_EQ(block_of(ReportText{"words", ReportText::Tone::kVerdict}),
            Json::parse(R"({"type": "text", "tone": "verdict", "text": "words"})"));
  EXPECT_EQ(block_of(ReportList{{"a", "b"}})["items"], Json({"a", "b"}));
  EXPECT_EQ(block_of(ReportFacts{{{"size", "1 N m", "rms"}}})["items"][0]["note"], "rms");
  EXPECT_EQ(block_of(ReportTable{{"", "x"}, {{"a", 1.5}, {"b", NAN}}, 2})["rows"],
            Json::parse(R"([["a", 1.5], ["b", null]])"));
  EXPECT_EQ(block_of(ReportCode{"x = 1;"})["text"], "x = 1;");
  EXPECT_EQ(block_of(ReportFormula{{"torque = a"}})["lines"][0], "torque = a");
  ReportBars bars{"rms", "t", "c", {{"joint 1", "N m", true, {{"alone", Role::kBefore, NAN}}}}};
  EXPECT_TRUE(block_of(bars)["groups"][0]["bars"][0]["value"].is_null());
  EXPECT_EQ(block_of(bars)["groups"][0]["marked"], true);
  Eigen::Matrix2d alike;
  alike << 1, 0.456, 0.456, NAN;
  EXPECT_EQ(block_of(ReportMatrix{"m", "t", "c", {"a", "b"}, alike})["hundredths"],
            Json::parse("[[100], [46, null]]"));
  EXPECT_EQ(block_of(chart("a"))["choice"], "recording");
  ReportArm arm;
  arm.joints = {{"waist", 0, true, {1, 2, 3}, {0, 0, 1}, {{0, 0, 0}, {1, 2, 3}}, true}};
  EXPECT_EQ(block_of(arm)["joints"][0]["link"], Json::parse("[[0.0,0.0,0.0],[1.0,2.0,3.0]]"));
  EXPECT_EQ(block_of(arm)["joints"][0]["prismatic"], true);
}

TEST(DocumentJson, CannotEndItsElement) {
  const std::string evil = "</script><!--<script>&\xe2\x80\xa8\xe2\x80\xa9\xff\"\\";
  ReportDocument own = document(ReportText{evil});
  own.title = evil;
  const std::string text = document_json(own);
  for (const char* part : {"<", ">", "&", "\xe2\x80\xa8", "\xe2\x80\xa9", "\n", "\xff"}) {
    EXPECT_EQ(text.find(part), std::string::npos) << part;
  }
  // and it is what was told, but for bytes that are no text
  EXPECT_EQ(Json::parse(text)["title"],
            "</script><!--<script>&\xe2\x80\xa8\xe2\x80\xa9\xef\xbf\xbd\"\\");
  const std::string page = report_page(own);
  EXPECT_EQ(page.find("<!--<script>"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script\\u003e"), std::string::npos);
}

TEST(DocumentJson, IsTheSameTwice) {
  EXPECT_EQ(report_page(document(chart("a"))), report_page(document(chart("a"))));
}

TEST(ReportDocument, RefusesWhatThePageCannotShow) {
  const auto wrong = [](ReportBlock block) {
    EXPECT_THROW(document_json(document(std::move(block))), std::invalid_argument);
  };
  EXPECT_NO_THROW(document_json(document(chart("a-1"))));
  wrong(ReportMatrix{"m", "t", "", {"a", "b"}, MatrixXd::Zero(3, 3)});
  wrong(ReportMatrix{"M", "t", "", {"a"}, MatrixXd::Zero(1, 1)});
  wrong(chart("A b"));
  wrong(chart(""));
  wrong(chart("part"));  // the id of the part that it is in
  ReportChart own = chart("a");
  own.views[0].panels[0].series[0].y = Eigen::Vector2d(0, 1);
  wrong(own);
  own = chart("a");
  own.views[0].panels[0].series[0].high.resize(0);
  wrong(own);
  own = chart("a");
  own.views[0].panels[0].x[1] = 0;
  wrong(own);
  own = chart("a");
  own.views[0].panels[0].clouds[0].y.resize(1);
  wrong(own);
  wrong(ReportTable{{"a", "b"}, {{"only one"}}, 0});
  wrong(ReportChart{"a", "", "", {}, "b"});  // there is no such chart
}

TEST(DocumentJson, SaysTwiceOnlyWhatDiffers) {
  ReportChart own = chart("a");
  own.views[0].panels.push_back(own.views[0].panels[0]);
  own.views[0].panels.push_back(own.views[0].panels[0]);
  own.views[0].panels[2].x[2] = 3;
  const Json panels = block_of(own)["views"][0]["panels"];
  EXPECT_TRUE(panels[1]["x"].is_null());
  EXPECT_EQ(panels[2]["x"], Json({0, 1, 3}));
}

/// Held-out torque of a million samples of seven joints, as views_for_report() thins it.
std::vector<HeldoutView> long_recording(Index samples, Index joints, const ViewBudget& budget) {
  const VectorXd time = VectorXd::LinSpaced(samples, 0, static_cast<double>(samples) / 1000);
  MatrixXd signals(samples, 4 * joints);
  for (Index j = 0; j < signals.cols(); ++j) {
    for (Index k = 0; k < samples; ++k) {
      signals(k, j) =
          std::sin(0.37 * static_cast<double>(k * (j + 1)) + 1e-3 * static_cast<double>(k));
    }
  }
  const ThinnedSignals thin = thinned_signals(time, signals, heldout_slices(budget, joints, 1));
  return {{"long.csv", thin.x, thin.y.leftCols(joints), thin.y.middleCols(joints, joints),
           thin.y.middleCols(2 * joints, joints), thin.y.rightCols(joints)}};
}

TEST(ReportPage, OfAMillionSamplesIsBelowFiveMegabytes) {
  const ViewBudget budget;
  const Index joints = 7;
  const std::vector<HeldoutView> heldout = long_recording(1'000'000, joints, budget);
  ReportDocument own = document(ReportText{"long"});
  auto& blocks = own.sections[0].parts[0].blocks;
  for (int j = 0; j < joints; ++j) {
    blocks.emplace_back(proof_chart(heldout, j, 0.1, "N m", "joint-" + std::to_string(j)));
  }
  // as many findings as a diagnosis gives, with all points that the budget has
  const AxisLabel label = [](const std::string& name) { return name; };
  for (int i = 0; i < 8; ++i) {
    ResidualView view;
    const Index points = budget.points / 8;
    const auto values = [&](Index n, double phase) -> VectorXd {
      return (VectorXd::LinSpaced(n, 0, 100).array() + phase).sin() * 12.3456;
    };
    view.left = values(points, 0.1 * i);
    view.effect = values(points, 0.2 * i);
    view.direction = view.left.array().sign().cast<int>();
    for (int v = 0; v < 6; ++v) {
      CoordinateView over;
      over.variable = "q" + std::to_string(v + 1);
      over.x = VectorXd::LinSpaced(budget.bins, 0, 1);
      over.cloud_x = values(points, v);
      const VectorXd bins = values(budget.bins, v);
      for (const int way : {1, -1}) {
        over.directions.push_back(
            {way, bins, bins, bins, bins, bins, bins, bins, bins, bins, bins});
      }
      view.over.push_back(std::move(over));
    }
    blocks.emplace_back(where_chart(view, {}, label, "N m", "where-" + std::to_string(i)));
    blocks.emplace_back(model_chart(view, label, "N m", "model-" + std::to_string(i)));
  }
  const std::string page = report_page(own);
  RecordProperty("bytes", static_cast<int>(page.size()));
  EXPECT_LT(page.size(), 5'000'000u);
  EXPECT_GT(page.size(), 1'500'000u);  // it does show something
}

}  // namespace
}  // namespace dyngen::runtime
