// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "gen/symoro/par_reader.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen {
namespace {

/// A tree: link 3 hangs on link 1 with gamma and b.
const std::string kTree =
    "(* Robotname = 'tree arm' *)\nNL = 3\nNJ = 3\nNF = 3\nType = 1\nis_mobile = 0\n"
    "(* Geometric parameters *)\nant = {0,1,\n  1}\nsigma = {0,1,0}\nb = {0,0,0.2}\n"
    "d = {0,0.3,0.1}\ngamma = {0,0,pi/3}\nr = {0.5,r2 + 0.05,0}\nalpha = {0,Pi/2,-pi/2}\n"
    "mu = {1,1,0}\ntheta = {th1 - pi/2,0,t3}\n"
    "XX = {0.1,0.2,0.3}\nYY = {0.1,0.2,0.3}\nZZ = {0.12,0.2,0.3}\nMX = {0.1,0,0.05}\n"
    "M = {2,3,1}\nIA={0.01,0.02,0.03}; FV = {1,1,1}\nFS = {0,0,0}\nG = {0,0,-9.81}\n"
    "FX = {0,0,FX3}\nQP = {QP1,QP2,QP3}\nZ = {1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1}\n";

std::string par_error(std::string text) {
  try {
    parse_robot(std::move(text), "arm.par");
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(Symoro, ReadsATreeWithItsFixedSteps) {
  const RobotFile file = parse_robot(kTree, "arm.par");
  EXPECT_EQ(file.name, "tree_arm");
  EXPECT_EQ(file.joint_count, 4);
  const RobotModel model = build_model(file);
  EXPECT_EQ(model.coordinate_count, 3);
  EXPECT_EQ(model.joint(3).type, JointType::kFixed);
  EXPECT_EQ(model.joint(3).parent, 1);
  EXPECT_TRUE(model.joint(3).theta.is_equal(GiNaC::Pi / 3));
  EXPECT_EQ(model.joint(4).parent, 3);
  EXPECT_TRUE(model.joint(1).theta.is_equal(-GiNaC::Pi / 2));
  EXPECT_TRUE(model.joint(2).r.value.is_equal(GiNaC::numeric(1, 20)));
  EXPECT_TRUE(model.joint(4).d.value.is_equal(GiNaC::numeric(1, 10)));
  EXPECT_TRUE(model.gravity[2].value.is_equal(GiNaC::numeric(981, 100)));
  EXPECT_TRUE(model.joint(2).chi[index(Chi::kM)].value.is_equal(3));
  EXPECT_TRUE(model.joint(3).chi[index(Chi::kM)].known_zero());
  EXPECT_EQ(model.joint(1).d.line, 12);
}

TEST(Symoro, SymbolsAreUnknownNumbers) {
  std::string text = with_replaced(kTree, "M = {2,3,1}", "M = {M1,3,M3}");
  text = with_replaced(text, "d = {0,0.3,0.1}", "d = {0,D2,-D3}");
  const RobotFile file = parse_robot(text, "arm.par");
  const RobotModel model = build_model(file);
  EXPECT_TRUE(model.joint(1).chi[index(Chi::kM)].unknown);
  EXPECT_FALSE(model.joint(2).chi[index(Chi::kM)].unknown);
  EXPECT_TRUE(model.joint(2).d.unknown);
  ASSERT_FALSE(file.warnings.empty());
  EXPECT_NE(file.warnings.front().message.find("'-D3' in d"), std::string::npos);
}

TEST(Symoro, WhatIsNotModelledIsRefusedByName) {
  EXPECT_NE(par_error(with_replaced(kTree, "NF = 3", "NF = 5")).find("closed loop"),
            std::string::npos);
  EXPECT_NE(
      par_error(with_replaced(kTree, "Type = 1", "Type = 2")).find("arm.par:5:1: error: a closed"),
      std::string::npos)
      << par_error(with_replaced(kTree, "Type = 1", "Type = 2"));
  EXPECT_NE(par_error(with_replaced(kTree, "is_mobile = 0", "is_mobile = 1")).find("is_mobile"),
            std::string::npos);
  EXPECT_NE(par_error(with_replaced(kTree, "Pi/2", "A2")).find("'A2' in alpha is a symbol"),
            std::string::npos);
  EXPECT_NE(
      par_error(with_replaced(kTree, "d = {0,0.3,0.1}", "d = {0,0.3}")).find("d has 2 values"),
      std::string::npos);
  EXPECT_NE(par_error(with_replaced(kTree, "mu =", "nu =")).find("'nu' is unknown"),
            std::string::npos);
  EXPECT_NE(par_error(with_replaced(kTree, "th1 - pi/2", "2*th1")).find("variable plus a number"),
            std::string::npos);
  EXPECT_NE(par_error(with_replaced(kTree, "th1 - pi/2", "t3")).find("moves a second joint"),
            std::string::npos)
      << par_error(with_replaced(kTree, "th1 - pi/2", "t3"));
  EXPECT_NE(par_error(with_replaced(kTree, "d = {0,0.3,0.1}", "d = {0,0.3,0.1}\neta = {0,1,0}"))
                .find("eta is 1: an elastic joint"),
            std::string::npos);
  for (const char* empty : {"{0,,0.1}", "{,0,0.1}", "{0,0.1,}"}) {
    EXPECT_NE(par_error(with_replaced(kTree, "{0,0.3,0.1}", empty)).find("found nothing"),
              std::string::npos)
        << par_error(with_replaced(kTree, "{0,0.3,0.1}", empty));
  }
  EXPECT_NE(par_error(kTree + "(* no end"), "");
  EXPECT_NE(par_error("NL = 3\nant = {0,1,5}\n").find("antecedent of link 3"), std::string::npos);
  EXPECT_NE(par_error("NL = x\n"), "");
  EXPECT_NE(par_error("NL = 3\nd = {0,"), "");
}

TEST(Symoro, OptionsOfLinksAreRefused) {
  RobotSource source("arm.par");
  source.tip = "hand";
  try {
    parse_robot(kTree, source);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("--tip is for URDF and MJCF"), std::string::npos);
  }
}

}  // namespace
}  // namespace dyngen
