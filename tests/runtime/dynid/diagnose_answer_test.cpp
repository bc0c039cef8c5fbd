// SPDX-License-Identifier: MIT
// What dynid diagnose writes of a diagnosis: its JSON, its page, its text.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/report/document_json.h"
#include "runtime/tools/dynid/diagnose/diagnosis_document.h"
#include "runtime/tools/dynid/options/page_options.h"
#include "runtime/tools/dynid/page/arm_drawing.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/made_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Json = nlohmann::json;
using test::made_report;

DiagnosisReport empty_report() {
  DiagnosisReport report;
  report.robot = "arm";
  report.revolute = {true, false};
  return report;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(DiagnosisJson, HasEveryKeyOfTheSchema) {
  EXPECT_EQ(test::schema_faults(Json::parse(diagnosis_json(made_report()))),
            std::vector<std::string>{});
  EXPECT_EQ(test::schema_faults(Json::parse(diagnosis_json(empty_report()))),
            std::vector<std::string>{});
}

TEST(DiagnosisJson, TheSchemaIsReallyAsked) {
  const Json whole = Json::parse(diagnosis_json(made_report()));
  // every key, at every depth, is missed
  int tried = 0;
  for (const Json::json_pointer& place : test::all_keys(whole)) {
    Json without = whole;
    without[place.parent_pointer()].erase(place.back());
    EXPECT_NE(test::schema_faults(without).size(), 0u) << place.to_string();
    ++tried;
  }
  EXPECT_GT(tried, 60);
  Json more = whole;
  more["findings"][0]["extra"] = 1;
  EXPECT_EQ(test::schema_faults(more).size(), 1u);
  more = whole;
  more["verdict"] = "perhaps";
  EXPECT_EQ(test::schema_faults(more).size(), 1u);
}

TEST(DiagnosisJson, SaysWhatTheDiagnosisSays) {
  const Json json = Json::parse(diagnosis_json(made_report()));
  EXPECT_EQ(json["schema"], "dynid.diagnosis/1");
  EXPECT_EQ(json["robot"], "puma560_3dof");
  EXPECT_EQ(json["joints"], 3);
  EXPECT_EQ(json["verdict"], "unexplained_structure");
  const Json& first = json["findings"][0];
  EXPECT_EQ(first["family"], "stribeck");
  EXPECT_EQ(first["joint"], 2);
  EXPECT_TRUE(first["other_joint"].is_null());
  EXPECT_EQ(first["aliases"], Json({"stribeck", "presliding"}));
  EXPECT_EQ(first["where"], Json::parse(R"({"variable": "qd2", "from": -0.25, "to": 0.25,
                                            "t_from": null, "t_to": null, "share": 0.75})"));
  EXPECT_EQ(first["formula"], "(Fs - Fc)*fall*sign(qd) where fall = exp(-(abs(qd)/vs)^delta)");
  EXPECT_EQ(first["parameters"]["Fs"],
            Json::parse(R"({"value": 13.0, "std": 0.25, "unit": "N m"})"));
  EXPECT_TRUE(first["parameters"]["delta"]["std"].is_null());
  EXPECT_EQ(first["evidence"]["delta_bic"], -95);
  EXPECT_EQ(first["unusual"],
            Json({"vs = 0.15 rad/s: unusual, a wider curve is curved viscous friction"}));
  const Json& second = json["findings"][1];
  EXPECT_EQ(second["family"], "joint_coupling");
  EXPECT_EQ(second["unusual"], Json::array());
  EXPECT_EQ(second["joint"], 3);
  EXPECT_EQ(second["other_joint"], 2);
  EXPECT_TRUE(second["where"]["variable"].is_null());
  EXPECT_EQ(second["where"]["t_to"], 7);
  EXPECT_EQ(json["undecidable"][3]["joint"], 0);
  EXPECT_EQ(json["unexplained"][0]["unit"], "N m");
  EXPECT_EQ(json["certificate"][0],
            Json::parse(R"({"family": "backlash", "joint": 1, "smallest_detectable": 0.002,
                            "unit": "rad"})"));
  EXPECT_EQ(json["certificate"][2]["joint"], 0);
  EXPECT_TRUE(json["certificate"][3]["smallest_detectable"].is_null());
  EXPECT_EQ(json["base_parameters"][0],
            Json::parse(R"({"name": "ZZ1R", "before": 1.1, "after": 1.2, "std": 0.02})"));
  EXPECT_EQ(json["heldout"]["unit"], "N m");
  EXPECT_EQ(json["heldout"]["rms_after"], Json({0.9, 1.0, 3.0}));
  EXPECT_TRUE(json["heldout"]["noise_floor"][2].is_null());
  EXPECT_EQ(json["next_experiment"]["purpose"], "separate stribeck from presliding on joint 2");
  EXPECT_TRUE(json["next_experiment"]["trajectory"].is_null());
}

TEST(DiagnosisJson, OfNothingIsNull) {
  const Json json = Json::parse(diagnosis_json(empty_report()));
  EXPECT_EQ(json["verdict"], "insufficient_data");
  EXPECT_TRUE(json["next_experiment"]["purpose"].is_null());
  EXPECT_EQ(json["heldout"]["rms_before"], Json::array());
}

TEST(DiagnosisJson, HoldsOutNamesThatAreNotUtf8) {
  DiagnosisReport report = made_report();
  report.robot = "arm\xff";
  EXPECT_NO_THROW(static_cast<void>(Json::parse(diagnosis_json(report))));
}

std::string page_of(const DiagnosisReport& report) {
  return report_page(diagnosis_document(report));
}

TEST(DiagnosisPage, IsTheTemplateAndNeedsNothingElse) {
  for (const DiagnosisReport& report : {made_report(), empty_report()}) {
    const std::string page = page_of(report);
    EXPECT_EQ(test::page_fault(page), "");
    // the addresses in it are names: of the project that draws charts, of markup
    for (const char* part : {"<link", "<img", "@import", "src=\"", "url(http"}) {
      EXPECT_FALSE(contains(page, part)) << part;
    }
    EXPECT_TRUE(contains(page, "default-src 'none'"));
  }
  const std::string page = page_of(made_report());
  EXPECT_NE(test::page_fault(page + " "), "");
  EXPECT_NE(test::page_fault("x" + page), "");
  EXPECT_NE(test::page_fault(""), "");
}

TEST(DiagnosisPage, EscapesWhatItIsTold) {
  DiagnosisReport report = made_report();
  report.robot = "</script><script>alert(1)</script>@REPORT@\xe2\x80\xa8\xff";
  const std::string page = page_of(report);
  EXPECT_EQ(test::page_fault(page), "");
  EXPECT_FALSE(contains(page, "alert(1)</script>"));
  EXPECT_TRUE(contains(page, "\\u003c/script\\u003e\\u003cscript\\u003ealert(1)"));
  EXPECT_TRUE(contains(page, "\\u2028"));
  const Json json = test::page_document(page);
  EXPECT_EQ(json["title"], "</script><script>alert(1)</script>@REPORT@\xe2\x80\xa8\xef\xbf\xbd");
  EXPECT_TRUE(contains(json.dump(), "something is left on joint 1 <&>"));
}

TEST(DiagnosisPage, HasEveryPartOfTheAnswer) {
  const Json json = test::page_document(page_of(made_report()));
  EXPECT_EQ(json["state"], "unexplained_structure");
  const std::string page = json.dump();
  for (const char* part : {"Two effects explain most",
                           "presliding",
                           "tell it from every",
                           "1. stribeck of joint 2",
                           "2. viscous_coupling of joint 3 with joint 2",
                           "Friction that falls with the speed (Stribeck)",
                           "torque = (Fs - Fc)*fall*sign(qd)",
                           "12.51 to 13.49",
                           "at its bound",
                           "held",
                           "qd2 from -0.25 to 0.25 rad/s",
                           "between 2 and 7 s",
                           "75 % of what",
                           "62.5 %",
                           "21 %",
                           "-95",
                           "vs <= 0.25*v90",
                           "failed",
                           "no <data>",
                           "-50.0 %",
                           "identical columns on any data",
                           "mooth over q1, without memory",
                           "slow both ways",
                           "To separate stribeck",
                           "ZZ1R",
                           "a lower bound",
                           "nothing above the noise",
                           "gap, rad",
                           "0.1 with 2",
                           "never",
                           "time base uniform, 500 Hz",
                           "held out",
                           "dynid 0.1.0, seed 7",
                           "dynid diagnose arm.robot"}) {
    EXPECT_TRUE(contains(page, part)) << part;
  }
}

/// The words at the left of a section's parts.
std::vector<std::string> steps_of(const Json& section) {
  std::vector<std::string> words;
  for (const Json& part : section["parts"]) words.push_back(part["word"]);
  return words;
}

TEST(DiagnosisPage, TellsAFindingInTheOrderOfItsQuestions) {
  const Json json = test::page_document(page_of(made_report()));
  EXPECT_EQ(json["sections"][0]["kind"], "first");
  for (const std::size_t finding : {1U, 2U}) {
    EXPECT_EQ(json["sections"][finding]["kind"], "finding");
    EXPECT_EQ(steps_of(json["sections"][finding]),
              (std::vector<std::string>{"Where", "What", "How much", "Model", "Proof",
                                        "What changed", "What next"}));
  }
  std::vector<std::string> others;
  for (std::size_t i = 3; i < json["sections"].size(); ++i)
    others.push_back(json["sections"][i]["id"]);
  EXPECT_EQ(others, (std::vector<std::string>{"unexplained", "heldout", "next-experiment",
                                              "certificate", "undecidable", "parameters",
                                              "structure", "condition", "noise", "origin"}));
}

TEST(DiagnosisPage, ShowsBarsOfEachJoint) {
  const Json json = test::page_document(page_of(made_report()));
  const Json bars = json["sections"][0]["parts"].back()["blocks"][0];
  ASSERT_EQ(bars["type"], "bars");
  ASSERT_EQ(bars["groups"].size(), 3u);
  EXPECT_EQ(bars["groups"][1]["bars"][0]["value"], 2);
  EXPECT_EQ(bars["groups"][1]["bars"][1]["value"], 1);
  EXPECT_EQ(bars["groups"][1]["bars"][2]["value"], 0.75);
  EXPECT_TRUE(bars["groups"][2]["bars"][2]["value"].is_null());
}

TEST(DiagnosisPage, LeavesOutPartsThatAreEmpty) {
  const Json json = test::page_document(page_of(empty_report()));
  std::vector<std::string> sections;
  for (const Json& section : json["sections"]) sections.push_back(section["id"]);
  EXPECT_EQ(sections, (std::vector<std::string>{"verdict", "origin"}));
}

TEST(ArmDrawing, PutsJointsWhereTheTableSays) {
  const ReportArm arm = arm_drawing(test::made_robot().model, Eigen::Vector3d(0, 0, 0), {1});
  ASSERT_EQ(arm.joints.size(), 3u);
  EXPECT_FALSE(arm.joints[0].marked);
  EXPECT_TRUE(arm.joints[1].marked);
  // the elbow: 0.4318 m along the upper arm, which lies in x at rest; its axis is -y
  EXPECT_NEAR(arm.joints[2].at[0], 0.4318, 1e-12);
  EXPECT_NEAR(arm.joints[2].at[1], 0, 1e-12);
  EXPECT_NEAR(arm.joints[2].axis[1], -1, 1e-12);
  EXPECT_NEAR(arm.up[2], 1, 1e-12);
  // lifted by a right angle it points up
  const ReportArm up = arm_drawing(test::made_robot().model, Eigen::Vector3d(0, M_PI / 2, 0), {});
  EXPECT_NEAR(up.joints[2].at[2], 0.4318, 1e-12);
}

TEST(DiagnosisText, FitsATerminal) {
  const std::string text = diagnosis_text(made_report());
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 25);
  for (const char* part :
       {"puma560_3dof: two effects explain most",
        "1. stribeck of joint 2, probability 0.97",
        "qd2 -0.25 .. 0.25 rad/s (75 %",
        "Fs = 13 +- 0.49 N m",
        "delta = 2 (held)",
        "held-out rms 21 % lower",
        "; or presliding; vs = 0.15 rad/s: unusual, a wider curve",
        "2. viscous_coupling of joint 3 with joint 2",
        "t 2 .. 7 s",
        "model alone",
        "with the findings",
        "joint 2    ##########          |           2                  1     0.75 N m\n",
        "joint 3    ###############     |           4                  3        - N m\n",
        "noise: from what the last model left",
        "joint 1: 0.4 N m over q1, qd1: smooth",
        "torque_offset, coulomb_asymmetry of joints 1, 2, 3: identical",
        "payload of the whole robot: the last",
        "next: separate stribeck from presliding on joint 2, by slow both ways",
        "dynid excite arm.robot --for d.json -o trajectory.csv",
        "not found: 4 effects, 3 of which",
        "written: report.html"}) {
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  }
}

/// What is left of joint 2 over its velocity: 1 N m backward, a peak of 3 N m forward.
ResidualView peak() {
  ResidualView view;
  view.joint = 1;
  CoordinateView over;
  over.variable = "qd2";
  over.x = Eigen::VectorXd::LinSpaced(48, -1, 1);
  for (const int way : {1, -1}) {
    DirectionView own;
    own.direction = way;
    own.left = (over.x.array() * way > 0).select(Eigen::VectorXd::Constant(48, way), NAN);
    if (way > 0) own.left[30] = 3;
    over.directions.push_back(std::move(own));
  }
  view.over.push_back(std::move(over));
  return view;
}

TEST(DiagnosisText, DrawsWhatIsLeftOverTheVariable) {
  DiagnosisReport report = made_report();
  report.views.findings = {peak()};
  const std::string plain = diagnosis_text(report);
  EXPECT_TRUE(contains(plain,
                       "     forward                          ______@_________________  "
                       "1 .. 3 N m over qd2\n"))
      << plain;
  EXPECT_TRUE(contains(plain, "     backward ________________________  ")) << plain;
  EXPECT_TRUE(std::all_of(plain.begin(), plain.end(),
                          [](char c) { return c == '\n' || (c >= 32 && c < 127); }));
  EXPECT_LE(std::count(plain.begin(), plain.end(), '\n'), 25);
  const std::string blocks = diagnosis_text(report, {false, true});
  EXPECT_TRUE(contains(blocks, "\u2581\u2588\u2581")) << blocks;
  EXPECT_FALSE(contains(blocks, "\x1b"));
}

TEST(DiagnosisText, HasColoursWhereTheyAreWanted) {
  DiagnosisReport report = made_report();
  report.views.findings = {peak()};
  std::string text = diagnosis_text(report, {true, false});
  EXPECT_TRUE(contains(text, "\x1b[34m############"));
  // without them it is the plain text
  for (std::size_t at = text.find('\x1b'); at != std::string::npos; at = text.find('\x1b')) {
    text.erase(at, text.find('m', at) + 1 - at);
  }
  EXPECT_EQ(text, diagnosis_text(report));
}

TEST(TextBar, IsAsLongAsItsPart) {
  EXPECT_EQ(text_bar(0.5, 8, {}), "####    ");
  EXPECT_EQ(text_bar(2, 4, {}), "####");
  EXPECT_EQ(text_bar(NAN, 4, {}), "    ");
  EXPECT_EQ(text_bar(0.5625, 2, {false, true}), "\u2588\u258f");
}

TEST(TextStyle, HasNoColoursBesideATerminal) {
  // the tests' output goes to a file or a pipe
  if (isatty(STDOUT_FILENO) == 1) GTEST_SKIP() << "standard output is a terminal";
  EXPECT_FALSE(style_of_output().colour);
}

TEST(DiagnosisText, IsShortWhereThereIsMuch) {
  DiagnosisReport report = made_report();
  for (int i = 0; i < 40; ++i) {
    report.diagnosis.undecidable.push_back({{"cable"}, 0, "reason " + std::to_string(i)});
    report.diagnosis.unexplained.push_back({0, {"q1"}, 1, "shape"});
  }
  const std::string text = diagnosis_text(report);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 27);
  EXPECT_TRUE(contains(text, "and 39 more, which the report lists")) << text;
}

TEST(CommandText, IsWhatAShellReads) {
  const char* const words[] = {"/somewhere/dynid", "diagnose", "a b.robot", "it's.csv", "-o", ""};
  EXPECT_EQ(command_text(6, words), "dynid diagnose 'a b.robot' 'it'\\''s.csv' -o ''");
}

}  // namespace
}  // namespace dyngen::runtime
