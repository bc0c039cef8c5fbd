// SPDX-License-Identifier: MIT
// Recordings of a Kinova Gen3 in which one joint moves, one way, and six stand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kArm = DYNGEN_SOURCE_DIR "/tests/data/robots/gen3.robot";
constexpr const char* kMap = " --map " DYNGEN_SOURCE_DIR "/examples/maps/kinova.yaml";

std::string sweep(int joint) {
  return shared_data(fmt::format("kinova_raw/joint_{}_trapez.csv.gz", joint)).value_or("");
}

/// The sum of first moments that the fit of a swept joint shows, kg m.
double first_moment(const Json& fit, const std::string& name) {
  for (const Json& sum : fit["seen_together"]) {
    const auto text = sum["combination"].get<std::string>();
    const bool own = sum["unit"] == "kg m" && text.find(name) != std::string::npos;
    if (own && text.find("MX") == std::string::npos) return sum["value"];
  }
  ADD_FAILURE() << "no sum with " << name << " in " << fit["seen_together"].dump(1);
  return 0;
}

// gravity by least squares on the torque alone, outside the project: 28 to 30 N m of joint 2, 9.4
// N m of joint 4
TEST(SingleJoints, OfARealArmShowItsGravity) {
  if (sweep(2).empty()) GTEST_SKIP() << skip_sentence("kinova_raw");
  const std::string folder = temporary_path("single_joints");
  const Outcome both =
      dynid(fmt::format("fit {} {} {}{} --json {}.json", kArm, sweep(2), sweep(4), kMap, folder));
  EXPECT_EQ(both.exit_code, 3) << both.out;  // the posture hides nearly everything
  EXPECT_EQ(both.out.find("swapped"), std::string::npos) << both.out;
  for (const int joint : {2, 4}) {
    const Outcome own =
        dynid(fmt::format("fit {} {}{} --json {}.json", kArm, sweep(joint), kMap, folder));
    EXPECT_EQ(own.exit_code, 3) << own.out;
    EXPECT_EQ(own.out.find("swapped"), std::string::npos) << own.out;
    EXPECT_NE(own.out.find("have no row"), std::string::npos) << own.out;
    EXPECT_NE(own.out.find("stand throughout"), std::string::npos) << own.out;
    const Json fit = Json::parse(content(folder + ".json"));
    EXPECT_LE(fit["seen_together"].size(), 6U);
    const double gravity = 9.81 * first_moment(fit, fmt::format("MYR{}", joint));
    EXPECT_NEAR(gravity, joint == 2 ? 29 : 9.4, joint == 2 ? 2 : 0.4);
    // what is hidden takes no part: no parameter is beyond what an arm has
    for (const Json& parameter : fit["parameters"]) {
      EXPECT_LT(std::abs(parameter["value"].get<double>()), 200) << parameter.dump();
    }
  }
}

TEST(SingleJoints, OfARealArmAreJudgedWhereTheyHaveEquations) {
  if (sweep(4).empty()) GTEST_SKIP() << skip_sentence("kinova_raw");
  const std::string json = temporary_path("single_joint.json");
  const Outcome run = dynid(fmt::format("diagnose {} {}{} --json {}", kArm, sweep(4), kMap, json));
  EXPECT_EQ(run.exit_code, 0) << run.out;
  const Json answer = Json::parse(content(json));
  EXPECT_EQ(answer["verdict"], "clean") << run.out;
  EXPECT_EQ(answer["not_judged"].size(), 6U);
  EXPECT_TRUE(answer["findings"].empty());
  // a motion of 2.7 s has too few equations, and the answer says how many are needed
  const Outcome brief = dynid(fmt::format("diagnose {} {}{}", kArm, sweep(2), kMap));
  EXPECT_EQ(brief.exit_code, 3) << brief.out;
  EXPECT_NE(brief.out.find("joint 2 has"), std::string::npos) << brief.out;
}

}  // namespace
}  // namespace dyngen::test
