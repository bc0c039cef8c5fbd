// SPDX-License-Identifier: MIT
// The Staubli TX40's recording, against figures that others published or a hand fit reached.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/identification/fit.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

constexpr const char* kFile = "tx40/tx40.csv";

struct Tx40 {
  DescribedRobot robot =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/tx40.robot", OpenParameters::kAbsentRows);

  /// @param part  of the run that is fitted; the rest is held out
  [[nodiscard]] MethodFit fit(const std::string& path, double part) const {
    const MotionSource all = motion_of_file(path, {});
    const MotionSource train = part_of(all, 0, part);
    FitData data;
    data.summary = summarise(robot.linear, train, {});
    data.rows = rows_of(robot.linear, train, RowOptions{});
    if (part < 1) {
      data.heldout = factor_of(rows_of(robot.linear, part_of(all, part, 1), RowOptions{}),
                               robot.linear.columns, robot.linear.size());
    }
    return fit_methods(robot.linear, data, {}).front();
  }
  [[nodiscard]] double value(const MethodFit& fit, const std::string& name) const {
    for (int i = 0; i < robot.linear.size(); ++i) {
      if (robot.linear.parameters[static_cast<std::size_t>(i)].name == name) {
        return fit.estimate.beta[i];
      }
    }
    ADD_FAILURE() << "no parameter " << name;
    return 0;
  }
};

TEST(Tx40, PredictsTheHeldOutPartAsWellAsTheHandFit) {
  const auto path = test::shared_data(kFile);
  if (!path) GTEST_SKIP() << test::skip_sentence(kFile);
  const Tx40 tx40;
  const MethodFit fit = tx40.fit(*path, 0.6);
  const std::array<double, 4> hand_fit = {8.4, 7.1, 12.1, 12.7};
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_LT(fit.heldout_percent[static_cast<Eigen::Index>(j)], hand_fit[j]) << "joint " << j + 1;
  }
}

TEST(Tx40, FindsThePublishedFrictionAndRotors) {
  const auto path = test::shared_data(kFile);
  if (!path) GTEST_SKIP() << test::skip_sentence(kFile);
  const Tx40 tx40;
  const MethodFit fit = tx40.fit(*path, 1);
  // Joints 5 and 6 rub on each other, which this model does not have: their friction is not
  // compared. Rotors of joints 1 and 2 are part of ZZR1 and ZZR2.
  const std::array<double, 4> viscous = {8.05, 5.53, 1.97, 1.11},
                              coulomb = {7.14, 8.26, 6.34, 2.48};
  for (std::size_t j = 0; j < 4; ++j) {
    const std::string joint = std::to_string(j + 1);
    EXPECT_NEAR(tx40.value(fit, "FV" + joint) / viscous[j], 1, 0.25);
    EXPECT_NEAR(tx40.value(fit, "FS" + joint) / coulomb[j], 1, 0.25);
  }
  EXPECT_NEAR(tx40.value(fit, "IA3") / 0.0988, 1, 0.25);
  EXPECT_NEAR(tx40.value(fit, "IA4") / 0.0313, 1, 0.25);
}

// The recording bends viscous friction, it shows no Stribeck effect: its rows must neither pretend
// one nor spoil what was not fitted.
TEST(Tx40, RowsOfStaticFrictionAreUnusualAndDoNotHarmTheHeldOutPart) {
  const auto path = test::shared_data(kFile);
  if (!path) GTEST_SKIP() << test::skip_sentence(kFile);
  std::string text = test::content(DYNGEN_SOURCE_DIR "/robots/tx40.robot");
  text.resize(text.rfind("stop"));
  for (const int joint : {1, 2, 3}) text += fmt::format("effect stribeck joint={}\n", joint);
  const std::string robot = test::temporary_path("tx40_stribeck.robot");
  const std::string json_path = test::temporary_path("tx40_stribeck.json");
  std::ofstream(robot) << text << "stop\n";
  const test::Outcome fit =
      test::dynid(fmt::format("fit {} {} --holdout-part 0.4 --json {}", robot, *path, json_path));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("unusual, a wider curve is curved viscous friction"), std::string::npos)
      << fit.out;
  const auto effects = nlohmann::json::parse(test::content(json_path))["effects"];
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_LT(effects["heldout_rms"][j].get<double>(),
              1.02 * effects["heldout_rms_without"][j].get<double>())
        << "joint " << j + 1;
  }
}

}  // namespace
}  // namespace dyngen::runtime
