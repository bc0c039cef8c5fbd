// SPDX-License-Identifier: MIT
/// What of rivals is left once each family has one.
#include "runtime/diagnosis/names/rival_families.h"

#include <gtest/gtest.h>

namespace dyngen::runtime {
namespace {

Rival rival_of(const std::string& family, const std::string& name, double net, double apart,
               std::size_t hypothesis) {
  Rival rival;
  rival.family = family;
  rival.name = name;
  rival.distance = net;
  rival.apart = apart;
  rival.hypothesis = hypothesis;
  return rival;
}

TEST(RivalFamilies, HaveTheEffectThatExplainsMostAndImitateAsWellAsAnyOfThem) {
  const std::map<std::string, Rival> best = best_of_families(
      {rival_of("spring", "straight", 37, 29, 0), rival_of("spring", "between points", 34, 4, 1),
       rival_of("friction", "position", 10, 60, 2)});
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best.at("spring").name, "straight");
  EXPECT_EQ(best.at("spring").distance, 37);
  EXPECT_EQ(best.at("spring").apart, 4);
  EXPECT_EQ(best.at("friction").apart, 60);
  // in whatever order they come
  const std::map<std::string, Rival> other = best_of_families(
      {rival_of("spring", "between points", 34, 4, 1), rival_of("spring", "straight", 37, 29, 0)});
  EXPECT_EQ(other.at("spring").name, "straight");
  EXPECT_EQ(other.at("spring").apart, 4);
}

TEST(RivalFamilies, LoseWhatExplainsNoMoreThanItContains) {
  std::vector<Hypothesis> hypotheses(3);
  hypotheses[1].effect.law.contains = {"curve"};
  const auto left = [&](double wider, double narrower, double winner) {
    std::vector<Rival> rivals = {rival_of("curve", "narrow", narrower, 0, 0),
                                 rival_of("memory", "wide", wider, 0, 1)};
    drop_what_adds_nothing(rivals, hypotheses, "elsewhere", winner);
    return rivals.size();
  };
  EXPECT_EQ(left(30, 20, 50), 2U);
  EXPECT_EQ(left(20, 30, 50), 1U);
  // the winner itself may be what it contains
  std::vector<Rival> rivals = {rival_of("memory", "wide", 40, 0, 1)};
  drop_what_adds_nothing(rivals, hypotheses, "curve", 50);
  EXPECT_TRUE(rivals.empty());
}

}  // namespace
}  // namespace dyngen::runtime
