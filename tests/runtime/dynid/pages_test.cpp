// SPDX-License-Identifier: MIT
// What the pages of dynid fit, atlas and excite hold: the document in them, beside the JSON of the
// same run.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;
using test::temporary_path;

const std::string kArm = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";

/// A recording of the arm with noise. @return its path
std::string recording(const std::string& name, std::uint64_t seed) {
  const DescribedRobot robot = describe_robot(kArm, OpenParameters::kAsWritten);
  Recording own =
      test::multisine(robot.linear, robot.grouping * robot.standard,
                      {.seconds = 10, .torque_noise = 0.3, .encoder_step = 1e-5, .seed = seed});
  own.dq.resize(0, 0);
  own.ddq.resize(0, 0);
  write_recording(own, temporary_path(name));
  return temporary_path(name);
}

/// The document in a page.
Json page(const std::string& file) {
  const std::string html = content(file), mark = "type=\"application/json\">";
  const std::size_t begin = html.find(mark) + mark.size();
  EXPECT_NE(html.find(mark), std::string::npos) << file;
  return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

Json section(const Json& document, const std::string& id) {
  for (const Json& own : document["sections"]) {
    if (own["id"] == id) return own;
  }
  ADD_FAILURE() << "no section " << id;
  return {};
}

/// The blocks of a kind in a section.
std::vector<Json> blocks(const Json& section, const std::string& type) {
  std::vector<Json> found;
  for (const Json& part : section["parts"]) {
    for (const Json& block : part["blocks"]) {
      if (block["type"] == type) found.push_back(block);
    }
  }
  return found;
}

TEST(Pages, OfAFitHasItsNumbersAndItsTorque) {
  const Outcome run = dynid("fit " + kArm + " " + recording("run1.csv", 1) + " --holdout " +
                            recording("run2.csv", 2) + " --period off --json " +
                            temporary_path("fit.json") + " --report " + temporary_path("fit.html"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("written: " + temporary_path("fit.html")), std::string::npos);
  const Json json = Json::parse(content(temporary_path("fit.json"))),
             document = page(temporary_path("fit.html"));
  EXPECT_EQ(document["kind"], "fit");
  EXPECT_EQ(document["state_text"], "determined");
  const Json rows = blocks(section(document, "parameters"), "table").at(0)["rows"];
  ASSERT_EQ(rows.size(), json["parameters"].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json& told = json["parameters"][i];
    EXPECT_EQ(rows[i][0], told["name"]);
    EXPECT_NEAR(rows[i][1].get<double>(), told["value"].get<double>(),
                1e-4 * std::abs(told["value"].get<double>()));
  }
  const std::vector<Json> charts = blocks(section(document, "torque"), "chart");
  ASSERT_EQ(charts.size(), 3u);
  for (const Json& chart : charts) {
    ASSERT_EQ(chart["views"].size(), 2u);  // held out, then fitted
    EXPECT_NE(chart["views"][0]["name"].get<std::string>().find("run2.csv (held out)"),
              std::string::npos);
    for (const Json& view : chart["views"]) {
      const Json& torque = view["panels"][0]["series"];
      const Json& left = view["panels"][1]["series"][0]["y"];
      double largest = 0;
      for (std::size_t k = 0; k < left.size(); ++k) {
        if (left[k].is_null()) continue;
        largest = std::max(largest, std::abs(left[k].get<double>()));
      }
      EXPECT_GT(largest, 0.01);
      EXPECT_LT(largest, 2);  // noise of 0.3 N m behind a filter
      EXPECT_EQ(torque[0]["y"].size(), left.size());
    }
  }
  const Json bars = blocks(section(document, "verdict"), "bars").at(0);
  EXPECT_EQ(bars["groups"].size(), 3u);
  EXPECT_NEAR(bars["groups"][1]["bars"][1]["value"].get<double>(), 0.3, 0.25);
}

TEST(Pages, OfAnAtlasHasEveryEffectOnce) {
  const Outcome run =
      dynid("atlas " + kArm + " " + recording("run.csv", 3) + " --json " +
            temporary_path("atlas.json") + " --report " + temporary_path("atlas.html"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const Json json = Json::parse(content(temporary_path("atlas.json"))),
             document = page(temporary_path("atlas.html"));
  std::size_t partly = 0, numbers = 0;
  for (const Json& entry : json["effects"]) {
    if (entry.contains("missing")) continue;
    ++numbers;
    partly += entry["kind"] == "partly" ? 1 : 0;
  }
  std::size_t told = 0;
  for (const Json& table : blocks(section(document, "absorbed"), "table")) {
    told += table["rows"].size();
  }
  EXPECT_EQ(told, numbers);
  const Json matrix = blocks(section(document, "alike"), "matrix").at(0);
  EXPECT_EQ(matrix["names"].size(), partly);
  ASSERT_EQ(matrix["hundredths"].size(), partly);
  for (std::size_t i = 0; i < partly; ++i) EXPECT_EQ(matrix["hundredths"][i][i], 100);
  double seen = 0;
  const Json bars = blocks(section(document, "verdict"), "bars").at(0);
  for (const Json& group : bars["groups"]) seen += group["bars"][0]["value"].get<double>();
  EXPECT_EQ(seen, static_cast<double>(partly));
}

#ifdef DYNGEN_WITH_NLOPT
/// The arm with limits.
std::string limited_arm() {
  std::string text = content(DYNGEN_SOURCE_DIR "/robots/planar2r.robot");
  text.insert(text.rfind("stop"), "qmin -2.5 -2.5\nqmax 2.5 2.5\nvmax 2 3\namax 8 12\n");
  std::ofstream(temporary_path("arm.robot")) << text;
  return temporary_path("arm.robot");
}

TEST(Pages, OfATrajectoryStaysWithinItsLimits) {
  const Outcome run = dynid("excite " + limited_arm() + " --evaluations 60 --json " +
                            temporary_path("excite.json") + " -o " + temporary_path("t.csv") +
                            " --report " + temporary_path("excite.html"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const Json document = page(temporary_path("excite.html"));
  EXPECT_EQ(document["kind"], "excitation");
  const Json chart = blocks(section(document, "trajectory"), "chart").at(0);
  EXPECT_EQ(chart["choice"], "show");
  std::vector<std::string> names;
  for (const Json& view : chart["views"]) {
    names.push_back(view["name"]);
    ASSERT_EQ(view["panels"].size(), 2u);
    for (const Json& panel : view["panels"]) {
      const Json &value = panel["series"][0]["y"], &lower = panel["series"][1]["y"],
                 &upper = panel["series"][2]["y"];
      for (std::size_t k = 0; k < value.size(); ++k) {
        EXPECT_GE(value[k].get<double>(), lower[k].get<double>() - 1e-4);
        EXPECT_LE(value[k].get<double>(), upper[k].get<double>() + 1e-4);
      }
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"position", "speed", "acceleration"}));
  const Json bars = blocks(section(document, "verdict"), "bars").at(0);
  const Json json = Json::parse(content(temporary_path("excite.json")));
  EXPECT_NEAR(bars["groups"][1]["bars"][1]["value"].get<double>(),
              json["largest_share_of_limits"]["speed"][1].get<double>(), 1e-4);
}
#endif

TEST(Pages, AreTheSameBytesTwice) {
  const std::string call = "fit " + kArm + " " + recording("run1.csv", 1) + " --report ";
  ASSERT_EQ(dynid(call + temporary_path("one.html")).exit_code, 0);
  const std::string first = content(temporary_path("one.html"));
  ASSERT_EQ(dynid(call + temporary_path("one.html")).exit_code, 0);
  EXPECT_EQ(content(temporary_path("one.html")), first);
}

}  // namespace
}  // namespace dyngen::runtime
