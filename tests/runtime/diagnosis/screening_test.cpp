// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/screening.h"

#include <gtest/gtest.h>

#include <set>

#include "runtime/diagnosis/scans/generic_columns.h"
#include "runtime/diagnosis/scans/structure_screening.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

class ScreeningTest : public testing::Test {
 protected:
  ScreeningTest()
      : data_(test::arm_recordings(
            test::two_recordings({test::known(test::spring_law(), 1, {0.3})}, 4))),
        screened_(data_),
        system_(test::arm_system(data_)),
        scales_(data_) {
    const std::vector<EffectLaw> laws = {test::spring_law(), test::load_friction_law()};
    for (const EffectInstance& effect : test::on_both_joints(laws)) {
      hypotheses_.push_back(hypothesis_of(effect, scales_.of(test::planar_arm_values(), effect)));
    }
  }

  Screening screening(const std::vector<Hypothesis>& hypotheses,
                      const std::vector<GenericResult>& known = {}) {
    return screen(screened_, system_, scales_, test::planar_arm_values(), hypotheses, structures_,
                  nullptr, {}, known);
  }

  EffectRecordings data_;
  ScreeningData screened_;
  EvidenceSystem system_;
  ScaleTable scales_;
  std::vector<GenericStructure> structures_ = generic_structures(2);
  std::vector<Hypothesis> hypotheses_;
};

TEST_F(ScreeningTest, TakesOverWhatIsKnownOfStructures) {
  const Screening whole = screening(hypotheses_);
  const Screening first = screening({});
  const Screening then = screening(hypotheses_, first.generic);
  EXPECT_GT(whole.tests, 100);
  EXPECT_EQ(then.tests, whole.tests);
  ASSERT_EQ(then.generic.size(), structures_.size());
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    EXPECT_EQ(then.generic[i].structure, i);
    EXPECT_EQ(then.generic[i].surprise, whole.generic[i].surprise);
  }
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    EXPECT_EQ(then.named[i].surprise, whole.named[i].surprise);
  }
}

TEST_F(ScreeningTest, DoesNotSeeWhatReadsASignalThatIsMissing) {
  const auto reading = [&](const char* variable) {
    const EffectInstance effect = test::unknown(
        test::algebraic_law(
            variable, {variable}, {{"k", EffectRole::kLinear, -1, 1, 0, 1}},
            [](const Eigen::VectorXd& v, const Eigen::VectorXd& p) { return p[0] * v[0]; }),
        1);
    return hypothesis_of(effect, scales_.of(test::planar_arm_values(), effect));
  };
  structures_.clear();
  const Screening seen = screening({reading("q"), reading("temp")});
  EXPECT_TRUE(seen.named[0].seen);
  EXPECT_FALSE(seen.named[1].seen);
  // a name that no recording can have is an error of the caller
  EXPECT_THROW(screening({reading("no_such")}), std::invalid_argument);
}

TEST_F(ScreeningTest, GroupsHoldEveryStructureOnce) {
  std::set<std::size_t> seen;
  std::size_t shared = 0;
  for (const std::vector<std::size_t>& group : structure_groups(structures_)) {
    for (const std::size_t place : group) {
      EXPECT_TRUE(seen.insert(place).second);
      EXPECT_EQ(structures_[place].form, structures_[group.front()].form);
      EXPECT_EQ(structures_[place].variables, structures_[group.front()].variables);
    }
    if (group.size() > 1) ++shared;
  }
  EXPECT_EQ(seen.size(), structures_.size());
  EXPECT_GT(shared, 5U);
}

/// A structure's own columns tell the same, made for it alone.
TEST_F(ScreeningTest, OfAGroupIsThatOfEachAlone) {
  const Screening all = screening({});
  EffectSignals signals(data_);
  signals.set_beta(test::planar_arm_values());
  signals.set_tangent_beta(test::planar_arm_values());
  int compared = 0;
  for (const GenericResult& result : all.generic) {
    GenericStructure structure = structures_[result.structure];
    if (!is_function(structure) && structure.form != GenericStructure::Form::kWave) continue;
    structure.frequency = result.frequency;
    const Score alone = score_of(
        system_.products(system_.whitened(generic_columns(data_, signals, structure))), true);
    EXPECT_NEAR(alone.delta_chi2, result.score.delta_chi2, 1e-9 * (1 + alone.delta_chi2))
        << result.structure;
    EXPECT_EQ(alone.degrees, result.score.degrees);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

}  // namespace
}  // namespace dyngen::runtime
