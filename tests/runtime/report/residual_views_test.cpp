// SPDX-License-Identifier: MIT
#include "runtime/report/residual_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/report/residual_charts.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Drawn {
  Diagnosis answer;
  DiagnosisViews views;
};

Drawn drawn(const std::vector<EffectInstance>& effects, const std::vector<EffectLaw>& laws,
            const std::vector<std::string>& plots, bool unnamed = false) {
  DiagnosisInput input = test::arm_input(test::two_recordings(effects, 1), effects, laws);
  if (unnamed) input.hypotheses.clear();
  Drawn result;
  result.answer = diagnose(input, test::every_sample(), {}, [&](const DiagnosedRecordings& shown) {
    result.views = views_for_report(shown, plots);
  });
  return result;
}

const CoordinateView* over(const ResidualView& view, const std::string& name) {
  for (const CoordinateView& own : view.over) {
    if (own.variable == name) return &own;
  }
  return nullptr;
}

TEST(StructureVariable, IsReadFromItsName) {
  using Kind = StructureVariable::Kind;
  for (const StructureVariable& variable :
       {StructureVariable{Kind::kPosition, 0}, StructureVariable{Kind::kVelocity, 11},
        StructureVariable{Kind::kAcceleration, 2}, StructureVariable{Kind::kLoad, 1},
        StructureVariable{Kind::kDistance, 6}, StructureVariable{Kind::kTime, -1}}) {
    EXPECT_EQ(variable_of_name(variable_name(variable)), variable) << variable_name(variable);
  }
  for (const char* name : {"", "q", "q0", "q1x", "temp1", "qd99999999999", "t1"}) {
    EXPECT_EQ(variable_of_name(name), std::nullopt) << name;
  }
}

TEST(ResidualViews, ShowASpringAsTheLineThatItIs) {
  const double k = 0.8;
  const Drawn result =
      drawn({test::known(test::spring_law(), 1, {k})}, {test::spring_law()}, {"q"});
  ASSERT_EQ(result.views.findings.size(), 1u);
  const ResidualView& view = result.views.findings[0];
  EXPECT_EQ(view.joint, 1);
  EXPECT_EQ(view.over[view.plot].variable, "q2");
  const CoordinateView* q = over(view, "q2");
  ASSERT_NE(q, nullptr);
  ASSERT_EQ(q->directions.size(), 1u);  // it does not depend on the direction
  const DirectionView& both = q->directions[0];
  const double estimate = result.answer.findings[0].parameters[0].value;
  const double half = result.answer.fit.interval * result.answer.findings[0].parameters[0].stddev;
  int inside = 0, all = 0;
  for (Index b = 0; b < q->x.size(); ++b) {
    if (!std::isfinite(both.model[b])) continue;
    EXPECT_NEAR(both.model[b], estimate * q->x[b], 1e-6);
    // of one parameter that torque is linear in, the band is its interval times x
    EXPECT_NEAR(both.model_high[b] - both.model[b], half * std::abs(q->x[b]), 1e-6);
    EXPECT_LE(both.effect_low[b], both.effect_high[b]);
    // means of some fifty samples whose noise is kArmNoise
    inside += std::abs(both.effect[b] - k * q->x[b]) < 0.1 ? 1 : 0;
    ++all;
  }
  EXPECT_GT(all, 40);
  EXPECT_GE(inside, all - 2);
  EXPECT_NEAR(view.size, estimate * std::sqrt(0.5) * 1.0, estimate);  // of its order
  EXPECT_GE(view.peak, view.size);
  EXPECT_GT(view.torque, view.size);
}

TEST(ResidualViews, SplitWhatTurnsWithTheDirection) {
  const Drawn result = drawn({test::known(test::load_friction_law(), 0, {0.15})},
                             {test::load_friction_law()}, {"tau_load"});
  ASSERT_EQ(result.views.findings.size(), 1u);
  const ResidualView& view = result.views.findings[0];
  const CoordinateView* load = over(view, "tau_load1");
  ASSERT_NE(load, nullptr);
  EXPECT_EQ(&view.over[view.plot], load);
  ASSERT_EQ(load->directions.size(), 2u);
  EXPECT_EQ(load->directions[0].direction, 1);
  EXPECT_EQ(load->directions[1].direction, -1);
  for (Index b = 0; b < load->x.size(); ++b) {
    for (const DirectionView& own : load->directions) {
      if (std::isfinite(own.model[b])) {
        EXPECT_GE(own.model[b] * own.direction, 0) << load->x[b];
      }
    }
  }
}

TEST(ResidualViews, FoldARippleToOnePeriod) {
  const Drawn result =
      drawn({test::known(test::ripple_law(), 1, {0.3, 0.1, 21})}, {test::ripple_law()}, {"q"});
  ASSERT_EQ(result.views.findings.size(), 1u);
  const ResidualView& view = result.views.findings[0];
  const CoordinateView& phase = view.over[view.plot];
  ASSERT_EQ(phase.variable, "phase2");
  EXPECT_GE(phase.x.minCoeff(), 0);
  EXPECT_LE(phase.x.maxCoeff(), 2 * M_PI);
  const VectorXd& p = result.answer.findings[0].effect.parameters;
  for (const DirectionView& own : phase.directions) {
    for (Index b = 0; b < phase.x.size(); ++b) {
      if (!std::isfinite(own.model[b])) continue;
      EXPECT_NEAR(own.model[b], p[0] * std::cos(phase.x[b]) + p[1] * std::sin(phase.x[b]), 0.01);
    }
  }
}

TEST(ResidualViews, OfStructureWithoutANameHaveNoModel) {
  const Drawn result = drawn({test::known(test::spring_law(), 0, {2.0})}, {}, {}, true);
  ASSERT_FALSE(result.views.unexplained.empty());
  EXPECT_TRUE(result.views.findings.empty());
  const ResidualView& view = result.views.unexplained[0];
  ASSERT_FALSE(view.over.empty());
  EXPECT_EQ(view.over[0].variable, result.answer.unexplained[0].variables[0]);
  EXPECT_EQ(view.over[0].directions[0].model.size(), 0);
  EXPECT_EQ(view.effect.size(), 0);
  const auto label = [](const std::string& name) { return name; };
  const ReportChart chart = where_chart(view, {}, label, "N m", "a");
  EXPECT_EQ(chart.views.size(), view.over.size());
}

TEST(ResidualViews, ProveWithWhatWasHeldOut) {
  const Drawn result =
      drawn({test::known(test::spring_law(), 1, {0.8})}, {test::spring_law()}, {"q"});
  ASSERT_EQ(result.views.heldout.size(), 1u);
  const HeldoutView& heldout = result.views.heldout[0];
  // few enough samples to be all there: their rms is the diagnosis's, but for rests and margins
  EXPECT_EQ(heldout.torque.rows(), heldout.time.size());
  for (const Index j : {0, 1}) {
    const auto rms = [&](const Eigen::MatrixXd& values) {
      return std::sqrt(values.col(j).squaredNorm() / static_cast<double>(values.rows()));
    };
    EXPECT_NEAR(rms(heldout.before), result.answer.heldout.before[j],
                0.1 * result.answer.heldout.before[j]);
    EXPECT_NEAR(rms(heldout.after), result.answer.heldout.after[j],
                0.1 * result.answer.heldout.after[j]);
  }
  EXPECT_TRUE((heldout.torque - heldout.model).isApprox(heldout.after, 1e-9));
  const ReportChart chart = proof_chart(result.views.heldout, 1, 0.1, "N m", "proof");
  ASSERT_EQ(chart.views.size(), 1u);
  ASSERT_EQ(chart.views[0].panels.size(), 2u);
  EXPECT_EQ(chart.views[0].panels[1].series[0].y, heldout.before.col(1));
}

TEST(ResidualViews, KeepToTheirBudget) {
  const std::vector<EffectInstance> effects = {test::known(test::spring_law(), 1, {0.8})};
  const DiagnosisInput input =
      test::arm_input(test::two_recordings(effects, 1), effects, {test::spring_law()});
  DiagnosisViews views;
  diagnose(input, test::every_sample(), {}, [&](const DiagnosedRecordings& shown) {
    views = views_for_report(shown, {"q"}, {20, 400, 1600});
  });
  ASSERT_EQ(views.findings.size(), 1u);
  EXPECT_LE(views.findings[0].left.size(), 420);
  for (const CoordinateView& own : views.findings[0].over) EXPECT_LE(own.x.size(), 20);
  EXPECT_EQ(views.heldout[0].time.size(), 200);
}

}  // namespace
}  // namespace dyngen::runtime
