// SPDX-License-Identifier: MIT
// What dynid diagnose writes of a diagnosis: its JSON, its page, its text.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/tools/dynid/diagnose_options.h"
#include "runtime/tools/dynid/html.h"
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
  const Json& second = json["findings"][1];
  EXPECT_EQ(second["family"], "joint_coupling");
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
  EXPECT_NO_THROW(Json::parse(diagnosis_json(report)));
}

TEST(DiagnosisPage, IsWellFormedAndNeedsNothingElse) {
  for (const DiagnosisReport& report : {made_report(), empty_report()}) {
    const std::string page = diagnosis_page(report);
    EXPECT_EQ(test::markup_fault(page), "");
    for (const char* part : {"http:", "https:", "src=", "url(", "<link", "@import", "<script"}) {
      EXPECT_FALSE(contains(page, part)) << part;
    }
  }
  EXPECT_NE(test::markup_fault("<p><b>wrong</p></b>"), "");
  EXPECT_NE(test::markup_fault("<p>wrong"), "");
  EXPECT_NE(test::markup_fault("<p>a & b</p>"), "");
}

TEST(DiagnosisPage, EscapesWhatItIsTold) {
  DiagnosisReport report = made_report();
  report.robot = "<script>alert(1)</script>";
  const std::string page = diagnosis_page(report);
  EXPECT_FALSE(contains(page, "<script"));
  EXPECT_TRUE(contains(page, "<h1>&lt;script&gt;alert(1)&lt;/script&gt;</h1>"));
  EXPECT_TRUE(contains(page, "joint 1 &lt;&amp;&gt;"));
  EXPECT_TRUE(contains(page, "run &quot;1&quot;.csv"));
  EXPECT_EQ(test::markup_fault(page), "");
}

TEST(DiagnosisPage, HasEveryPartOfTheAnswer) {
  const std::string page = diagnosis_page(made_report());
  for (const char* part : {"Two effects explain most",
                           "cannot tell these apart: stribeck, presliding.",
                           "tell it from every",
                           "1. stribeck of joint 2",
                           "2. viscous_coupling of joint 3 with "
                           "joint 2",
                           "Friction that falls as a joint begins to slide",
                           "torque = (Fs - Fc)*fall*sign(qd)",
                           "12.51 to 13.49",
                           "at its bound",
                           "held",
                           "qd2 from -0.25 to 0.25 rad/s",
                           "between 2 and 7 s",
                           "75 % of what",
                           "62.5 %",
                           "21.0 %",
                           "-95",
                           "vs &lt;= 0.25*v90",
                           "class=\"failed\"",
                           "no &lt;data&gt;",
                           "-50.0 %",
                           "aria-label=\"joint 2: 2 without, 1 with, noise 0.75\"",
                           "identical columns on any data",
                           "smooth over q1, without memory",
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
                           "20.0 s",
                           "dynid 0.1.0, seed 7",
                           "dynid diagnose arm.robot"}) {
    EXPECT_TRUE(contains(page, part)) << part;
  }
  EXPECT_TRUE(contains(page, "prefers-color-scheme: dark"));
  EXPECT_TRUE(contains(page, "@media print"));
}

TEST(DiagnosisPage, LeavesOutPartsThatAreEmpty) {
  const std::string page = diagnosis_page(empty_report());
  for (const char* part : {"cannot decide", "Structure without", "Next experiment", "not found,",
                           "changed in the model", "not fitted"}) {
    EXPECT_FALSE(contains(page, part)) << part;
  }
}

TEST(DiagnosisText, FitsATerminal) {
  const std::string text = diagnosis_text(made_report());
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 25);
  for (const char* part : {"puma560_3dof: two effects explain most",
                           "1. stribeck of joint 2, probability 0.97",
                           "qd2 -0.25 .. 0.25 rad/s (75 %",
                           "Fs = 13 +- 0.49 N m",
                           "delta = 2 (held)",
                           "held-out rms 21 % lower",
                           "; or presliding\n",
                           "2. viscous_coupling of joint 3 with joint 2",
                           "t 2 .. 7 s",
                           "1 N m",
                           "with the findings",
                           "floor of the noise",
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

TEST(DiagnosisText, IsShortWhereThereIsMuch) {
  DiagnosisReport report = made_report();
  for (int i = 0; i < 40; ++i) {
    report.diagnosis.undecidable.push_back({{"cable"}, 0, "reason " + std::to_string(i)});
    report.diagnosis.unexplained.push_back({0, {"q1"}, 1, "shape"});
  }
  const std::string text = diagnosis_text(report);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 27);
  EXPECT_TRUE(contains(text, "and 37 more, which the report lists")) << text;
}

TEST(CommandText, IsWhatAShellReads) {
  const char* const words[] = {"/somewhere/dynid", "diagnose", "a b.robot", "it's.csv", "-o", ""};
  EXPECT_EQ(command_text(6, words), "dynid diagnose 'a b.robot' 'it'\\''s.csv' -o ''");
}

}  // namespace
}  // namespace dyngen::runtime
