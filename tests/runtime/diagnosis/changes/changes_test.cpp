// SPDX-License-Identifier: MIT
// What changed between sessions of an arm whose truth is known: which names are told, whether
// sessions without a change are accused, whether intervals hold the truth.
#include "runtime/diagnosis/changes/changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/runtime/diagnosis/changes/compared_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::ComparedArm;
using Names = std::vector<std::string>;

VectorXd change_of(Index place, double by) { return VectorXd::Unit(13, place) * by; }

struct Kind {
  std::string name;
  ComparedArm arm;
  Names expected;
};

/// One of every kind, each some ten standard deviations of what its sessions scatter.
std::vector<Kind> kinds() {
  std::vector<Kind> all;
  const auto add = [&](const std::string& name, const VectorXd& change, Names expected) {
    ComparedArm arm;
    arm.change = change;
    all.push_back({name, arm, std::move(expected)});
  };
  add("Coulomb", change_of(7, -1.2), {"friction_change 1"});
  add("viscous", change_of(10, 0.45), {"friction_change 2"});
  add("friction", change_of(8, 0.6) + change_of(10, 0.4), {"friction_change 2"});
  add("offset", change_of(11, 0.9), {"coulomb_asymmetry 1"});
  add("rotor", change_of(6, 0.1), {"rotor_inertia 2"});
  add("tip load", test::load_of(2, 0.5, 0.3, 0.05, 0.002), {"payload 0"});
  add("inner load", test::load_of(1, 0.6, 0.25, -0.1, 0.003), {"payload 1"});
  add("load taken off", test::load_of(2, -0.4, 0.2, 0.1, 0), {"payload 0"});
  add("both frictions", change_of(7, -1.2) + change_of(8, -0.6) + change_of(9, -0.8),
      {"friction_change 1", "friction_change 2"});
  ComparedArm gain;
  gain.effects = {test::known(test::gain_law(), 1, {-0.12})};
  gain.effects.front().link = 2;
  all.push_back({"gain", gain, {"torque_gain 2"}});
  ComparedArm cable;
  cable.effects = {test::known(test::spring_law(), 1, {0.5})};
  all.push_back({"cable", cable, {"gravity_spring 2"}});
  return all;
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Changes, NamesEveryKind) {
  int right = 0, all = 0, loads = 0;
  for (const Kind& kind : kinds()) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
      ComparedArm arm = kind.arm;
      arm.seed = seed;
      arm.before = arm.after = seed % 2 == 0 ? 3 : 4;
      const ChangesSince changes = test::changes_of(arm);
      const Names names = test::names_of(changes);
      ++all;
      const bool named = sorted(names) == sorted(kind.expected);
      right += named ? 1 : 0;
      const bool friction = kind.expected.front().starts_with("friction");
      for (const std::string& name : names)
        loads += friction && name.starts_with("payload") ? 1 : 0;
      if (!named) {
        std::printf("%s, seed %u: %s (%s)\n", kind.name.c_str(), seed, joined(names).c_str(),
                    changes.sessions.c_str());
      }
      for (const Finding& finding : changes.findings) {
        EXPECT_TRUE(finding.since_reference);
        EXPECT_EQ(finding.aliases.front(), finding.effect.law.family);
        EXPECT_FALSE(finding.why.empty());
        EXPECT_LT(finding.evidence.delta_bic, 0);
      }
    }
  }
  std::printf("named right: %d of %d\n", right, all);
  EXPECT_GE(right, std::ceil(0.95 * all));
  EXPECT_EQ(loads, 0);
}

// what the model lacks on both sides is in later sessions too, and yet it did not come
TEST(Changes, AnEffectOfBothSidesIsNoChange) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    ComparedArm arm;
    arm.seed = seed;
    arm.always = {test::known(test::spring_law(), 1, {2})};
    EXPECT_EQ(test::names_of(test::changes_of(arm)), Names()) << "seed " << seed;
    arm.change = change_of(7, -1.2);
    EXPECT_EQ(test::names_of(test::changes_of(arm)), Names{"friction_change 1"}) << "seed " << seed;
    arm.change.setZero();
    arm.effects = {test::known(test::spring_law(), 1, {1})};
    EXPECT_EQ(test::names_of(test::changes_of(arm)), Names{"gravity_spring 2"}) << "seed " << seed;
  }
}

TEST(Changes, AccusesNoSessionsThatOnlyScatter) {
  for (const int sessions : {1, 2, 4}) {
    int accused = 0;
    constexpr int kCases = 20;
    for (unsigned seed = 1; seed <= kCases; ++seed) {
      ComparedArm arm;
      arm.before = arm.after = sessions;
      arm.scatter = seed % 2 == 0 ? 0.05 : 0.08;
      arm.coefficient = seed % 3 == 0 ? 0.9 : 0.5;
      arm.seed = 100 + seed;
      const Names names = test::names_of(test::changes_of(arm));
      if (names.empty()) continue;
      ++accused;
      std::printf("%d sessions, seed %u: %s\n", sessions, arm.seed, joined(names).c_str());
    }
    std::printf("%d sessions a side: %d of %d accused\n", sessions, accused, kCases);
    EXPECT_EQ(accused, 0) << sessions;
  }
}

/// One file each: what is allowed between sessions stands for what cannot be estimated.
TEST(Changes, OfOneSessionEachAreJudgedByTheAllowance) {
  ComparedArm arm;
  arm.before = arm.after = 1;
  arm.change = change_of(7, -2.4);
  const ChangesSince friction = test::changes_of(arm);
  EXPECT_EQ(test::names_of(friction), Names{"friction_change 1"});
  EXPECT_NE(friction.sessions.find("that is allowed"), std::string::npos) << friction.sessions;
  // a tenth of it is what a cold morning makes
  arm.change = change_of(7, -0.24);
  EXPECT_EQ(test::names_of(test::changes_of(arm)), Names{});
  arm.change = test::load_of(2, 0.8, 0.3, 0.05, 0.002);
  EXPECT_EQ(test::names_of(test::changes_of(arm)), Names{"payload 0"});
}

TEST(Changes, IntervalsHoldTheLoad) {
  int within = 0, moment = 0, all = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    ComparedArm arm;
    arm.before = arm.after = 2 + static_cast<int>(seed % 3);
    const double mass = 0.4 + 0.002 * seed;
    arm.change = test::load_of(2, mass, 0.25, 0.05, 0.004);
    arm.seed = 1000 + seed;
    const ChangesSince changes = test::changes_of(arm);
    for (const Finding& finding : changes.findings) {
      if (finding.effect.law.family != "payload" || finding.effect.joint != -1) continue;
      ++all;
      const EffectParameterFit &m = finding.parameters[9], &mx = finding.parameters[6];
      EXPECT_TRUE(m.seen);
      within += std::abs(m.value - mass) < 1.96 * m.stddev ? 1 : 0;
      moment += std::abs(mx.value - 0.25 * mass) < 1.96 * mx.stddev ? 1 : 0;
      // an arm in a plane never shows these
      for (const std::size_t hidden : {0U, 1U, 2U, 3U, 4U, 8U}) {
        EXPECT_FALSE(finding.parameters[hidden].seen);
        EXPECT_TRUE(std::isnan(finding.parameters[hidden].value));
      }
    }
  }
  std::printf("loads %d, mass within %.3f, first moment within %.3f\n", all,
              within / static_cast<double>(all), moment / static_cast<double>(all));
  EXPECT_GE(all, 195);
  EXPECT_GE(within, 0.92 * all);
  EXPECT_LE(within, 0.98 * all);
  EXPECT_GE(moment, 0.92 * all);
  EXPECT_LE(moment, 0.98 * all);
}

TEST(Changes, SaysBeforeAndAfter) {
  ComparedArm arm;
  arm.change = change_of(7, -1.2);
  const ChangesSince changes = test::changes_of(arm);
  ASSERT_EQ(changes.findings.size(), 1U);
  const Finding& finding = changes.findings.front();
  EXPECT_NE(finding.why.find("Fc "), std::string::npos) << finding.why;
  EXPECT_NE(finding.why.find(" -> "), std::string::npos) << finding.why;
  EXPECT_NEAR(finding.parameters[0].value, -1.2, 4 * finding.parameters[0].stddev);
  EXPECT_NE(changes.sessions.find("estimated"), std::string::npos) << changes.sessions;
}

}  // namespace
}  // namespace dyngen::runtime
