// SPDX-License-Identifier: MIT
#include "gen/effect_file/effect_file.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "gen/effect_code/bound_effect.h"
#include "gen/effect_file/effect_equations.h"
#include "gen/effect_file/units.h"
#include "gen/effects/effect_catalogue.h"

namespace dyngen {
namespace {

/// A file that is right; tests change a row of it.
const std::vector<std::string>& right_rows() {
  static const std::vector<std::string> kRows = {
      "effect bump",
      "family stribeck",
      "title A bump of friction",
      "kind algebraic",
      "scope joint",
      "parameter A linear unit=torque typical=0.1*Fc : its height",
      "parameter vs shape unit=rate min=1e-3 max=v_max typical=0.05 scale=log : its width",
      "torque A*exp(-(qd/vs)^2)*sign(qd)",
      "hidden little",
      "separate slow motion",
      "plot qd"};
  return kRows;
}

std::string text_with(std::size_t line, const std::string& row) {
  std::string text;
  for (std::size_t i = 0; i < right_rows().size(); ++i) {
    text += (i + 1 == line ? row : right_rows()[i]) + "\n";
  }
  return text;
}

std::string message_of(const std::string& text) {
  try {
    (void)parse_effect_file(text, "bump.effect");
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EffectFile, ReadsWhatIsRight) {
  const EffectFile effect = parse_effect_file(text_with(0, ""), "bump.effect");
  EXPECT_EQ(effect.name, "bump");
  ASSERT_EQ(effect.parameters.size(), 2U);
  EXPECT_EQ(effect.parameters[1].role, ParameterRole::kShape);
  EXPECT_TRUE(effect.parameters[1].logarithmic);
  EXPECT_EQ(effect.variables, (std::vector<std::string>{"qd", "sign_qd"}));
  EXPECT_TRUE(effect.runs_in_controller());
  EXPECT_EQ(spell(effect.torque[0]), "A*exp(-(qd/vs)^2)*sign(qd)");
  EXPECT_TRUE(effect.contains.empty());
}

TEST(EffectFile, ReadsWhatAnEffectContains) {
  const EffectFile effect = parse_effect_file(
      text_with(3, "title A bump\ncontains stribeck : where it is narrow"), "bump.effect");
  ASSERT_EQ(effect.contains.size(), 1U);
  EXPECT_EQ(effect.contains[0].family, "stribeck");
  EXPECT_EQ(effect.contains[0].text, "where it is narrow");
}

TEST(EffectFile, ReadsUsualRanges) {
  const EffectFile effect = parse_effect_file(
      text_with(
          9, "usual vs <= 0.25*v90 : it is narrow\nusual A >= 0.1*Fc : it is seen\nhidden little"),
      "bump.effect");
  ASSERT_EQ(effect.usual.size(), 2U);
  EXPECT_EQ(spell(effect.usual[0].left), "vs");
  EXPECT_EQ(spell(effect.usual[0].right), "0.25*v90");
  EXPECT_EQ(effect.usual[0].text, "it is narrow");
  EXPECT_EQ(spell(effect.usual[1].left), "0.1*Fc");  // turned round
  EXPECT_EQ(spell(effect.usual[1].right), "A");
  EXPECT_TRUE(effect.falsifiers.empty());
  EXPECT_TRUE(effect.requirements.empty());
}

TEST(EffectFile, APlainNumberInABoundHasTheUnitOfTheParameter) {
  const EffectFile effect = parse_effect_file(
      text_with(7,
                "parameter vs shape unit=rate min=max(1e-3,0.01*v_max) typical=0.05 : its width"),
      "bump.effect");
  EXPECT_EQ(spell(*effect.parameters[1].min), "max(0.001, 0.01*v_max)");
}

struct Mistake {
  const char* name;
  std::size_t line;
  const char* row;
  const char* message;
};

class WrongEffectFile : public testing::TestWithParam<Mistake> {};

TEST_P(WrongEffectFile, IsPointedAt) {
  const Mistake& mistake = GetParam();
  const std::string message = message_of(text_with(mistake.line, mistake.row));
  EXPECT_EQ(message.substr(0, message.find('\n')), std::string("bump.effect:") + mistake.message);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, WrongEffectFile,
    testing::ValuesIn(std::vector<Mistake>{
        {"Keyword", 3, "titel A bump", "3:1: error: unknown keyword 'titel'"},
        {"Family", 2, "family stribek", "2:8: error: unknown word 'stribek' in 'family'"},
        {"Contains", 3, "contains base : all", "3:10: error: unknown word 'base' in 'contains'"},
        {"Twice", 3, "effect bump", "3:1: error: row 'effect' stands twice"},
        {"Kind", 4, "kind stateful", "1:1: error: 'kind stateful' without a row 'state'"},
        {"Tangent", 8, "torque A*d_q*vs*sign(qd)",
         "1:1: error: the effect reads derivatives of the rigid model: expected 'kind tangent'"},
        {"UnknownName", 8, "torque A*exp(-(qd/vz)^2)*sign(qd)",
         "8:19: error: unknown name 'vz' in 'torque'"},
        {"UnknownFunction", 8, "torque A*expo(-(qd/vs)^2)", "8:10: error: unknown function 'expo'"},
        {"Arguments", 8, "torque A*max(qd/vs)", "8:10: error: max has 1 argument, expected 2"},
        {"Bracket", 8, "torque A*(qd/vs", "8:10: error: '(' without ')' in 'torque'"},
        {"TooEarly", 8, "torque A*", "8:10: error: the expression of 'torque' ends too early"},
        {"Sum", 8, "torque A + qd*sign(qd)/vs",
         "8:10: error: the two sides of '+' have units kg m^2 s^-2 and a pure number"},
        {"Argument", 8, "torque A*exp(tau_load)*vs/vs",
         "8:10: error: the argument of 'exp' has the unit kg m^2 s^-2"},
        {"TorqueUnit", 8, "torque A*qd*vs",
         "8:12: error: the torque has the unit kg m^2 s^-4, expected kg m^2 s^-2"},
        {"NotLinear", 8, "torque A^2/Fc*exp(-(qd/vs)^2)*sign(qd)",
         "6:11: error: the torque is not linear in 'A'"},
        {"Prismatic", 8, "torque A*sin(q)*vs/vs",
         "8:10: error: the argument of 'sin' has the unit m"},
        {"Unit", 6, "parameter A linear unit=torqe typical=1 : its height",
         "6:11: error: 'torqe' is no unit of 'A'"},
        {"NoUnit", 6, "parameter A linear typical=1 : its height",
         "6:11: error: parameter 'A' has no unit"},
        {"NoTypical", 6, "parameter A linear unit=torque : its height",
         "6:11: error: parameter 'A' has no typical size"},
        {"TypicalUnit", 6, "parameter A linear unit=torque typical=v_max : its height",
         "6:40: error: typical has the unit s^-1, expected kg m^2 s^-2"},
        {"Role", 6, "parameter A line unit=torque typical=1 : its height",
         "6:13: error: unknown word 'line' in 'parameter'"},
        {"Scanned", 7, "parameter vs scanned unit=rate typical=0.05 : its width",
         "7:11: error: 'vs' is scanned and lacks grid=, min= or max="},
        {"Reserved", 6, "parameter qd linear unit=torque typical=1 : its height",
         "6:11: error: 'qd' is the name of a variable already"},
        {"Unused", 7, "parameter ws shape unit=rate typical=0.05 : its width",
         "8:19: error: unknown name 'vs' in 'torque'"},
        {"Plot", 11, "plot speed", "1:1: error: row 'plot' names 'speed', which is no variable"},
        {"Partner", 8, "torque A*sign(qd_other)*vs/vs",
         "1:1: error: the effect reads another joint: expected 'scope pair'"},
        {"NoColon", 6, "parameter A linear unit=torque typical=1",
         "6:41: error: expected ':' and a text in 'parameter'"},
        {"UsualName", 9, "usual vz <= 0.25*v90 : narrow\nhidden little",
         "9:7: error: unknown name 'vz' in 'usual'"},
        {"UsualVariable", 9, "usual vs <= qd : narrow\nhidden little",
         "9:13: error: unknown name 'qd' in 'usual'"},
        {"UsualUnit", 9, "usual vs <= 0.25*Fc : narrow\nhidden little",
         "9:17: error: the right side has the unit kg m^2 s^-2, expected s^-1"},
        {"UsualRelation", 9, "usual vs = 0.25*v90 : narrow\nhidden little",
         "9:7: error: expected LEFT <= RIGHT in 'usual'"},
        {"UsualStrict", 9, "usual vs < 0.25*v90 : narrow\nhidden little",
         "9:10: error: expected '<=' or '>='"},
        {"UsualReason", 9, "usual vs <= 0.25*v90\nhidden little",
         "9:21: error: expected ':' and a text in 'usual'"},
        {"ChosenUnit", 7,
         "parameter vs shape unit=rate min=max(1,1.5*duration) typical=0.05 : its width",
         "7:43: error: min has the unit s, expected s^-1"},
        {"Missing", 9, "", "1:1: error: there is no row 'hidden'"}}),
    [](const testing::TestParamInfo<Mistake>& own) { return std::string(own.param.name); });

TEST(EffectFile, AMidpointIsAPositionThatDerivativesAreTakenBy) {
  const auto text = [](const std::string& unit, const std::string& torque,
                       const std::string& midpoint) {
    std::string rows;
    for (const std::string& row : right_rows()) {
      if (row.starts_with("kind")) {
        rows += "kind tangent\n";
      } else if (row.starts_with("parameter A")) {
        rows += "parameter A linear unit=" + unit + " typical=0.1 : its shift\n";
      } else if (row.starts_with("parameter vs") || row.starts_with("falsifier")) {
        continue;
      } else if (row.starts_with("torque")) {
        rows += torque + "\nmidpoint " + midpoint + "\n";
      } else {
        rows += row + "\n";
      }
    }
    return rows;
  };
  const auto first_line = [](const std::string& rows) {
    const std::string message = message_of(rows);
    return message.substr(0, message.find('\n'));
  };
  EXPECT_EQ(parse_effect_file(text("position", "torque A*d_q", "A"), "bump.effect").midpoint, "A");
  EXPECT_EQ(first_line(text("position", "torque A*d_q", "B")),
            "bump.effect:1:1: error: row 'midpoint' names 'B', which is no parameter");
  EXPECT_EQ(first_line(text("rate", "torque A*d_qd", "A")),
            "bump.effect:1:1: error: row 'midpoint' goes with 'scope joint' and a torque of d_q, "
            "d_alpha, d_d, d_theta, d_r");
}

std::string stateful_text(const std::string& start) {
  std::string text;
  for (const std::string& row : right_rows()) {
    if (row.starts_with("kind")) {
      text += "kind stateful\njoints revolute\n";
    } else if (row.starts_with("torque")) {
      text += "state z unit=torque " + start + " : -vs*z\n" + row + " + z\n";
    } else {
      text += row + "\n";
    }
  }
  return text;
}

TEST(EffectFile, AStateBeginsWhereItsRowSays) {
  const EffectFile effect = parse_effect_file(stateful_text("start=2*tau_load"), "bump.effect");
  ASSERT_EQ(effect.states.size(), 1U);
  ASSERT_TRUE(effect.states[0].start.has_value());
  EXPECT_EQ(spell(*effect.states[0].start), "2*tau_load");
  // what only a start reads is read as well
  EXPECT_EQ(effect.variables, (std::vector<std::string>{"qd", "tau_load", "sign_qd"}));
  EXPECT_FALSE(parse_effect_file(stateful_text(""), "bump.effect").states[0].start.has_value());
  const auto first_line = [](const std::string& start) {
    const std::string message = message_of(stateful_text(start));
    return message.substr(0, message.find('\n'));
  };
  EXPECT_EQ(first_line("start=z"), "bump.effect:9:27: error: unknown name 'z' in 'start'");
  EXPECT_EQ(first_line("start=A"), "bump.effect:9:27: error: unknown name 'A' in 'start'");
  EXPECT_EQ(first_line("start=qd"),
            "bump.effect:9:27: error: start has the unit s^-1, expected kg m^2 s^-2");
  EXPECT_EQ(first_line("begin=1"),
            "bump.effect:9:21: error: expected unit=, min=, max= or start=, found 'begin=1'");
}

TEST(EffectFile, SaysUpToTwentyMistakesAtOnce) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += "nonsense\n";
  const std::string message = message_of(text);
  std::size_t count = 0;
  for (std::size_t at = message.find("error:"); at != message.npos;
       at = message.find("error:", at + 1)) {
    ++count;
  }
  EXPECT_GE(count, 20U);
  EXPECT_LE(count, 21U);
}

TEST(EffectFile, NeverCrashesOnCutAndMixedText) {
  const std::string text = text_with(0, "");
  for (std::size_t cut = 0; cut < text.size(); ++cut) {
    (void)message_of(text.substr(0, cut));
    std::string changed = text;
    changed[cut] = static_cast<char>((cut * 37) % 256);
    (void)message_of(changed);
  }
}

TEST(EffectUnits, AreReadAndWritten) {
  EXPECT_EQ(unit_text("torque/rate", JointUnits::kRevolute), "N m s/rad");
  EXPECT_EQ(unit_text("torque/rate", JointUnits::kPrismatic), "N s/m");
  EXPECT_EQ(unit_text("kg.m^2", JointUnits::kRevolute), "kg m^2");
  EXPECT_EQ(unit_text("1", JointUnits::kRevolute), "1");
  EXPECT_EQ(dimension_of("torque", JointUnits::kRevolute),
            dimension_of("J", JointUnits::kRevolute));
  EXPECT_EQ(dimension_of("torque", JointUnits::kPrismatic),
            dimension_of("N", JointUnits::kPrismatic));
  EXPECT_FALSE(dimension_of("m..s", JointUnits::kRevolute));
  EXPECT_FALSE(dimension_of("m^x", JointUnits::kRevolute));
}

std::string bound_message(const std::string& row) {
  const std::string text =
      "name arm\nnumber_link 3\nsigma 0 1 2\nal 0 0 0\nd 0 0 0\nth 0 0 0\nr 0 0 0\nZZ 1 1 0\n"
      "M 0 1 0\nFs 1 1 0\n" +
      row + "\nstop\n";
  try {
    const EffectCatalogue catalogue;
    (void)bind_effects(build_model(parse_robot_file(text, "arm.robot")), catalogue);
  } catch (const ModelError& error) {
    const std::string message = error.what();
    return message.substr(0, message.find('\n'));
  }
  return "";
}

TEST(BoundEffect, SaysWhatIsWrongInARow) {
  EXPECT_EQ(bound_message("effect stribeck joint=1 Fs=2 vs=0.05"), "");
  EXPECT_EQ(bound_message("effect stribek joint=1"),
            "arm.robot:11:8: error: unknown effect 'stribek'");
  EXPECT_EQ(bound_message("effect stribeck Fs=2"),
            "arm.robot:11:8: error: effect 'stribeck' has no 'joint='");
  EXPECT_EQ(bound_message("effect stribeck joint=4"), "arm.robot:11:23: error: '4' is no joint");
  EXPECT_EQ(bound_message("effect stribeck joint=3"),
            "arm.robot:11:23: error: joint 3 does not move");
  EXPECT_EQ(bound_message("effect cogging joint=2 n=3"),
            "arm.robot:11:22: error: joint 2 is prismatic");
  EXPECT_EQ(bound_message("effect stribeck joint=1 fs=2"),
            "arm.robot:11:25: error: effect 'stribeck' has no 'fs'");
  EXPECT_EQ(bound_message("effect stribeck joint=1 Fs=-2"),
            "arm.robot:11:28: error: 'Fs' is -2: expected 0 or more");
  EXPECT_EQ(bound_message("effect coulomb_coupling joint=1 other=1"),
            "arm.robot:11:39: error: joint 1 is its own partner");
  EXPECT_EQ(bound_message("effect base_tilt joint=1"),
            "arm.robot:11:18: error: effect 'base_tilt' has no 'joint'");
  // a force on a link asks for no motion of its joint
  EXPECT_EQ(bound_message("effect contact joint=3 fz=5"), "");
}

TEST(EffectCatalogueTest, OnlyAForceOnALinkEndsAtItsJoint) {
  const EffectCatalogue catalogue;
  for (const auto& effect : catalogue.all()) {
    EXPECT_EQ(effect->acts_inward(), effect->family == "contact") << effect->name;
  }
}

/// What is slower than a recording cannot be told from the base model: no shape may be.
TEST(EffectCatalogueTest, OffersNoShapeThatIsSlowerThanTheRecording) {
  const EffectCatalogue catalogue;
  int shapes = 0;
  for (const double duration : {0.5, 5.0, 50.0, 500.0}) {
    const auto value_of = [duration](const std::string& name) {
      return name == "duration" ? duration : 1.0;
    };
    for (const auto& effect : catalogue.all()) {
      for (const EffectParameter& parameter : effect->parameters) {
        if (parameter.role != ParameterRole::kShape && parameter.role != ParameterRole::kScanned) {
          continue;
        }
        const std::string where = effect->name + " " + parameter.name;
        if (parameter.unit == "s") {
          ASSERT_TRUE(parameter.max) << where;
          EXPECT_LE(evaluate(*parameter.max, value_of), duration) << where;
        } else if (parameter.unit == "Hz") {
          ASSERT_TRUE(parameter.min) << where;
          EXPECT_GE(evaluate(*parameter.min, value_of), 1.5 / duration) << where;
        } else {
          continue;
        }
        ++shapes;
      }
    }
  }
  EXPECT_GE(shapes, 4 * 6);
}

TEST(EffectCatalogueTest, HoldsItsOwnEffectsInTheOrderOfTheFamilies) {
  const EffectCatalogue catalogue;
  EXPECT_GE(catalogue.all().size(), 60U);
  EXPECT_EQ(catalogue.all().front()->family, "torque_offset");
  EXPECT_EQ(catalogue.find("no_such_effect"), nullptr);
}

TEST(StatesAfter, LeavesStatesWhereTheyAreInAStepOfZero) {
  const EffectCatalogue catalogue;
  for (const auto& effect : catalogue.all()) {
    std::map<std::string, GiNaC::symbol> symbols;
    const EffectValues values = [&](const std::string& name) {
      return GiNaC::ex(symbols.try_emplace(name, name).first->second);
    };
    const std::vector<GiNaC::ex> after = states_after(*effect, values, 0);
    for (std::size_t s = 0; s < after.size(); ++s) {
      if (effect->states[s].min) continue;  // limited, it stands behind min() and max()
      EXPECT_TRUE((after[s] - values(effect->states[s].name)).expand().is_zero()) << effect->name;
    }
  }
}

}  // namespace
}  // namespace dyngen
