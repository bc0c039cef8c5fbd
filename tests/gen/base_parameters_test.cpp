// SPDX-License-Identifier: MIT
#include "gen/base_parameters/base_parameters.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_rank.h"
#include "tests/support/oracle_data.h"

namespace dyngen::test {
namespace {

struct Counts {
  int inertial, with_rotor, gravity;
  bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& counts) {
  return out << counts.inertial << "/" << counts.with_rotor << "/" << counts.gravity;
}

int count(const RobotModel& model, Motions motions) {
  return static_cast<int>(regroup(make_symbolic(model), motions).parameters.size());
}

Counts base_counts(const RobotModel& model) {
  const RobotModel inertial = with_unknown_parameters(model, true);
  RobotModel rotor = inertial;
  for (JointModel& joint : rotor.joints) joint.chi[index(Chi::kIA)].unknown = true;
  return {count(inertial, Motions::kAll), count(rotor, Motions::kAll),
          count(inertial, Motions::kStanding)};
}

TEST(BaseParameters, CountsAreTheOraclesOnes) {
  EXPECT_EQ(base_counts(read_model("robots/planar2r.robot")), (Counts{6, 7, 4}));
  EXPECT_EQ(base_counts(read_model("tests/robots/rp.robot")), (Counts{6, 7, 3}));
  EXPECT_EQ(base_counts(read_model("robots/scara.robot")), (Counts{8, 11, 1}));
  EXPECT_EQ(base_counts(read_model("robots/stanford.robot")), (Counts{33, 37, 9}));
  EXPECT_EQ(base_counts(read_model("robots/rx90.robot")), (Counts{36, 40, 10}));
  EXPECT_EQ(base_counts(read_model("robots/ur10e.robot")), (Counts{36, 40, 10}));
  EXPECT_EQ(base_counts(read_model("robots/panda.robot")), (Counts{43, 48, 12}));
  EXPECT_EQ(base_counts(read_model("robots/puma560.robot")), (Counts{36, 40, 10}));
  EXPECT_EQ(base_counts(read_model("robots/puma560_3dof.robot")), (Counts{15, 16, 4}));
  EXPECT_EQ(base_counts(read_model("robots/sarcos_grla.robot")), (Counts{45, 50, 14}));
}

TEST(BaseParameters, WithoutGravityFewerAreSeen) {
  const auto without_gravity = [](const std::string& path) {
    RobotModel model = with_unknown_parameters(read_model(path), true);
    for (Quantity& component : model.gravity) component = {};
    return count(model, Motions::kAll);
  };
  EXPECT_EQ(without_gravity("robots/planar2r.robot"), 4);
  EXPECT_EQ(without_gravity("tests/robots/rp.robot"), 4);
  EXPECT_EQ(without_gravity("robots/scara.robot"), 8);
  EXPECT_EQ(without_gravity("robots/stanford.robot"), 31);
  EXPECT_EQ(without_gravity("robots/rx90.robot"), 34);
  EXPECT_EQ(without_gravity("robots/ur10e.robot"), 34);
  EXPECT_EQ(without_gravity("robots/panda.robot"), 39);
  EXPECT_EQ(without_gravity("robots/sarcos_grla.robot"), 39);
}

TEST(BaseParameters, CountsAreTheJudgesRanksInStandardFramesToo) {
  for (const std::string& name : oracle_names()) {
    const Oracle oracle = load_oracle(name);
    for (const NumericRobot& robot : {oracle.robot, oracle.standard.value_or(oracle.robot)}) {
      const BaseParameterRanks ranks = base_parameter_ranks(robot);
      const Counts wanted{ranks.inertial.rank, ranks.inertial_and_rotor.rank, ranks.gravity.rank};
      EXPECT_EQ(base_counts(robot_model(robot)), wanted) << name;
    }
  }
}

/// The relations of tests/data/oracles/puma3_info.json for joint offsets r2 = r3 = 0.
TEST(BaseParameters, Puma3RelationsAreTheClosedForm) {
  const SymbolicRobot robot =
      make_symbolic(with_unknown_parameters(read_model("robots/puma560_3dof.robot"), true));
  const auto symbol = [&](const std::string& name) -> GiNaC::ex {
    for (const FileSymbol& entry : robot.parameters) {
      if (entry.name == name) return entry.symbol;
    }
    throw std::invalid_argument(name);
  };
  const GiNaC::ex L = GiNaC::numeric(4318, 10000);
  const GiNaC::ex M3 = symbol("M3"), YY2 = symbol("YY2"), YY3 = symbol("YY3");
  const std::map<std::string, GiNaC::ex> wanted = {{"ZZR1", symbol("ZZ1") + YY2 + YY3 + L * L * M3},
                                                   {"XXR2", symbol("XX2") - YY2 - L * L * M3},
                                                   {"XY2", symbol("XY2")},
                                                   {"XZR2", symbol("XZ2") - L * symbol("MZ3")},
                                                   {"YZ2", symbol("YZ2")},
                                                   {"ZZR2", symbol("ZZ2") + L * L * M3},
                                                   {"MXR2", symbol("MX2") + L * M3},
                                                   {"MY2", symbol("MY2")},
                                                   {"XXR3", symbol("XX3") - YY3},
                                                   {"XY3", symbol("XY3")},
                                                   {"XZ3", symbol("XZ3")},
                                                   {"YZ3", symbol("YZ3")},
                                                   {"ZZ3", symbol("ZZ3")},
                                                   {"MX3", symbol("MX3")},
                                                   {"MY3", symbol("MY3")}};
  const Regrouping grouping = regroup(robot);
  ASSERT_EQ(grouping.parameters.size(), wanted.size());
  for (const GroupedParameter& parameter : grouping.parameters) {
    const auto it = wanted.find(parameter.name());
    ASSERT_NE(it, wanted.end()) << parameter.name();
    const GiNaC::ex difference = parameter.value - it->second;
    EXPECT_TRUE(difference.expand().is_zero()) << parameter.name() << ": " << difference;
  }
}

TEST(BaseParameters, FirstRotorIsGroupedWithTheFirstInertia) {
  const Regrouping grouping =
      regroup(make_symbolic(with_unknown_parameters(read_model("robots/planar2r.robot"), false)));
  EXPECT_EQ(grouping.parameters.front().name(), "ZZR1");
  for (const GroupedParameter& parameter : grouping.parameters) {
    EXPECT_FALSE(parameter.column == (Column{1, Chi::kIA}));
  }
}

TEST(BaseParameters, DependencyOfAPrismaticAxisParallelToATurnIsFound) {
  // SCARA: the first moments of the sliding link turn with the arm that carries it
  const Regrouping grouping =
      regroup(make_symbolic(with_unknown_parameters(read_model("robots/scara.robot"), true)));
  std::string names;
  for (const GroupedParameter& parameter : grouping.parameters) names += parameter.name() + " ";
  EXPECT_EQ(names, "ZZR1 ZZR2 MXR2 MYR2 MR3 ZZ4 MX4 MY4 ");
}

TEST(BaseParameters, RunTimeLengthsLeaveTheSetMinimal) {
  RobotModel model = with_unknown_parameters(read_model("robots/scara.robot"), true);
  for (JointModel& joint : model.joints) {
    joint.d.unknown = !joint.d.known_zero();
    joint.r.unknown = !joint.r.known_zero();
  }
  const SymbolicRobot robot = make_symbolic(model);
  const Regrouping grouping = regroup(robot);
  EXPECT_TRUE(grouping.unsolved.empty());
  std::map<std::string, GiNaC::ex> values;
  std::string names;
  for (const GroupedParameter& parameter : grouping.parameters) {
    values[parameter.name()] = parameter.value;
    names += parameter.name() + " ";
  }
  EXPECT_EQ(names, "ZZR1 ZZR2 MXR2 MYR2 MR3 ZZ4 MX4 MY4 ");
  // d3 turns into a coefficient of ZZR2 and of MXR2: both lengths stand in the formulas
  const GiNaC::ex d3 = robot.link(3).d;
  const GiNaC::ex MX3 = robot.link(3).chi[index(Chi::kMX)];
  EXPECT_TRUE((values.at("ZZR2").expand().coeff(MX3) - 2 * d3).is_zero()) << values.at("ZZR2");
  EXPECT_TRUE((values.at("MXR2").expand().coeff(MX3) - 1).is_zero()) << values.at("MXR2");
}

}  // namespace
}  // namespace dyngen::test
