// SPDX-License-Identifier: MIT
#include "runtime/import/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace dyngen::test {
namespace {

using runtime::ImportError;
using runtime::ImportMap;
using runtime::parse_import_map;
using testing::HasSubstr;

const std::string kPlain =
    "time: {column: t, unit: s}\n"
    "position: {columns: \"q{n}\", unit: rad}\n"
    "torque: {columns: \"tau{n}\", unit: N m}\n";

/// What is said of a map that is wrong.
std::string fault_of(const std::string& text) {
  try {
    parse_import_map(text, "map.yaml");
  } catch (const ImportError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(MapFile, ReadsWhatAnEngineerWrites) {
  const ImportMap map = parse_import_map(
      "time: {column: Time, unit: ms}\n"
      "position: {columns: \"Position{n}\", unit: rad, side: motor, offset: [0, -90 deg, pi/2 "
      "rad]}\n"
      "torque: {columns: [a, b, c], unit: A, side: motor, constant: 0.1 N m/A, delay: 3 ms}\n"
      "gears: [32, 1798/7, -48]\n"
      "runs: {split: phase, keep: [on, ok], skip_first: 500 ms, cut: [[1 s, 2 s]]}\n",
      "map.yaml");
  EXPECT_EQ(map.joints, 3);
  EXPECT_EQ(map.time.unit, "ms");
  EXPECT_NEAR(map.position->offset[1], -std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(map.position->offset[2], std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(map.torque->constant, std::vector<double>{0.1});
  EXPECT_DOUBLE_EQ(map.torque->delay, 0.003);
  EXPECT_DOUBLE_EQ(map.gears[1], 1798.0 / 7);
  EXPECT_EQ(map.runs.keep.names.size(), 2U);
  EXPECT_DOUBLE_EQ(map.runs.skip_first, 0.5);
  EXPECT_DOUBLE_EQ(map.runs.cuts[0].second, 2);
}

TEST(MapFile, ExpandsNumberedColumnsOfAFileWithoutHeader) {
  const ImportMap map = parse_import_map(
      "format: {columns: [time, \"q{1..3}\"], separator: tab, skip: 2}\n" + kPlain, "m");
  ASSERT_TRUE(map.text.columns);
  EXPECT_EQ(*map.text.columns, (std::vector<std::string>{"time", "q1", "q2", "q3"}));
  EXPECT_EQ(map.text.separator, '\t');
  EXPECT_EQ(map.text.skip_lines, 2U);
}

TEST(MapFile, NamesTheNearestKey) {
  EXPECT_THAT(fault_of(kPlain + "velocty: {columns: v, unit: rad/s}\n"),
              HasSubstr("map.yaml:4:1: error: unknown key 'velocty' in 'the map'; did you mean "
                        "'velocity'?"));
  EXPECT_THAT(fault_of("time: {colum: t}\n"),
              HasSubstr("map.yaml:1:8: error: unknown key 'colum'"));
}

TEST(MapFile, RefusesWhatCannotBeMeant) {
  EXPECT_THAT(fault_of("time: {column: t, unit: parsec}\n"),
              HasSubstr("map.yaml:1:25: error: found unit 'parsec' of time, expected s, ms"));
  EXPECT_THAT(fault_of(kPlain + "gears: [1, 2]\n"), HasSubstr("does not say on which side"));
  EXPECT_THAT(fault_of("time: {rate: 0 Hz}\n"), HasSubstr("expected more than 0"));
  EXPECT_THAT(fault_of(kPlain + "joints: 2\n" + "gears: [1, 2, 3]\n"),
              HasSubstr("found 3 gears, expected 2 as there are joints, or one for all"));
  EXPECT_THAT(
      fault_of("time: {column: t, unit: s}\nposition: {columns: q, unit: rad, offset: -90}\n"),
      HasSubstr("map.yaml:2:43: error: found '-90' in 'position', expected an angle or a "
                "length with its unit"));
  EXPECT_THAT(fault_of(kPlain + kPlain), HasSubstr("found key 'time' a second time"));
  EXPECT_THAT(fault_of("coupling: [[1, 0], [1, 0]]\n"), HasSubstr("has no inverse"));
  EXPECT_THAT(fault_of("[1, 2"), HasSubstr("map.yaml:1:"));
  EXPECT_THAT(fault_of(""), HasSubstr("empty file"));
  EXPECT_THAT(fault_of("time: {column: t, unit: s}\n"), HasSubstr("found no 'position'"));
  EXPECT_THAT(fault_of(kPlain + "---\n" + kPlain), HasSubstr("a second document"));
}

TEST(MapFile, RefusesQuestionsThatAreOpen) {
  EXPECT_THAT(
      fault_of("time: {column: t, unit: s}\nposition: {columns: \"q{n}\", unit: \"?\"}\n"),
      HasSubstr("map.yaml:2:35: error: position: unit is a question that was not answered"));
  EXPECT_THAT(fault_of("time: {rate: \"?\"}\n"), HasSubstr("not answered"));
  // without quotes too
  EXPECT_THAT(fault_of("time: {column: t, unit: s}\nposition:\n  columns: q\n  unit: ?\n"),
              testing::Not(HasSubstr("no fault")));
}

TEST(MapFile, RefusesNumbersThatMeanNothing) {
  const auto with = [](const std::string& position, const std::string& torque = "") {
    return "time: {column: t, unit: s}\nposition: {columns: \"q{n}\", unit: rad" + position +
           "}\ntorque: {columns: \"tau{n}\"" + (torque.empty() ? ", unit: N m" : torque) + "}\n";
  };
  EXPECT_THAT(fault_of(with(", gain: 0")),
              HasSubstr("map.yaml:2:46: error: found gain 0, expected another number than 0"));
  EXPECT_THAT(fault_of(with(", gain: [1, 0, 2]")), HasSubstr("map.yaml:2:50: error: found gain 0"));
  EXPECT_THAT(fault_of(with(", gain: nan")), HasSubstr("found 'nan' in 'position', expected a"));
  EXPECT_THAT(fault_of(with(", gain: .inf")), HasSubstr("found '.inf' in 'position', expected a"));
  EXPECT_THAT(fault_of(with(", gain: 1e300 * 1e300")), HasSubstr("expected a finite number"));
  EXPECT_THAT(fault_of(with(", gain: 1/0")), HasSubstr("expected a number without a unit"));
  EXPECT_THAT(fault_of(with(", offset: 1e308 * 1e308 deg")), HasSubstr("a finite number"));
  EXPECT_THAT(fault_of(with("", ", unit: A, constant: 0")), HasSubstr("found constant 0"));
  EXPECT_THAT(fault_of(with("", ", unit: \"%\", rated: 0")), HasSubstr("found rated 0"));
  EXPECT_THAT(fault_of("time: {column: t, unit: s}\nposition: {columns: q, unit: counts, "
                       "counts_per_rev: 0}\ntorque: {columns: tau, unit: N m}\n"),
              HasSubstr("found counts_per_rev 0"));
  const std::string duty =
      "time: {column: t, unit: s}\nposition: {columns: q, unit: rad}\nvelocity: {columns: v, "
      "unit: rad/s}\n";
  EXPECT_THAT(fault_of(duty + "torque: {duty: d, full: 0, voltage: 0, resistance: 0, constant: 1}"),
              testing::AllOf(HasSubstr("found full 0"), HasSubstr("found voltage 0"),
                             HasSubstr("found resistance 0, expected more than 0 ohm")));
  EXPECT_THAT(fault_of(kPlain + "gears: [3, 0]\n"),
              HasSubstr("map.yaml:4:12: error: found a gear"));
}

}  // namespace
}  // namespace dyngen::test
