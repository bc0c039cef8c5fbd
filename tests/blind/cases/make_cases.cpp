// SPDX-License-Identifier: MIT
// blind_make: simulates cases, writes their recordings, and apart from them what is in them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/blind/cases/case.h"
#include "tests/blind/cases/habit.h"

namespace blind {
namespace {

namespace fs = std::filesystem;

/// A name that says nothing: of the seed, through a generator of its own.
std::string case_name(std::uint64_t seed) {
  Random random(seed ^ 0x5EA1EDULL);
  std::string name;
  for (int i = 0; i < 12; ++i) name += "0123456789abcdef"[random.below(16)];
  return name;
}

struct Order {
  CaseOptions options;
  int count = 1, part = 0, parts = 1;
  fs::path out, sealed, arms;
};

void make(const Order& order) {
  fs::create_directories(order.out);
  fs::create_directories(order.sealed);
  fs::permissions(order.sealed, fs::perms::owner_all);
  constexpr std::uint64_t kTries = 50;
  for (int i = order.part; i < order.count; i += order.parts) {
    for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
      CaseOptions options = order.options;
      options.seed = (order.options.seed + static_cast<std::uint64_t>(i)) * kTries + attempt;
      std::optional<Case> made;
      try {
        made = make_case(options, order.arms);
      } catch (const std::runtime_error& error) {
        fmt::print(stderr, "seed {}: {}\n", options.seed, error.what());
      }
      if (!made) continue;
      const std::string name = case_name(options.seed);
      write_case(*made, order.arms, order.out / name);
      nlohmann::json entry = manifest_entry(*made);
      entry["case"] = name;
      std::ofstream(order.sealed / (name + ".json")) << entry.dump(1) << '\n';
      fmt::print("{} of {}\n", i + 1, order.count);
      std::fflush(stdout);
      break;
    }
  }
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Simulates cases of the blind suite."};
  blind::Order order;
  bool quiet = false;
  app.add_option("--kind", order.options.kind, "null single pair hidden foreign passing crowd")
      ->check(CLI::IsMember({"null", "single", "pair", "hidden", "foreign", "passing", "crowd"}));
  app.add_option("--lambda", order.options.lambda, "wanted strength")->check(CLI::PositiveNumber);
  app.add_option("--family", order.options.family, "of single effects; else drawn");
  app.add_option("--joint", order.options.joint, "of the effects, from 1; else drawn")
      ->check(CLI::PositiveNumber);
  app.add_option("--arm", order.options.arm,
                 "planar2 twisted4 puma560 ur10e panda; small: one of the first two; else drawn");
  std::vector<std::string> names;
  for (const blind::Habit& habit : blind::habits()) names.push_back(habit.name);
  app.add_option("--habit", order.options.habit, "of recording; else the laboratory's")
      ->check(CLI::IsMember(names));
  const std::map<std::string, blind::Colour> colours = {
      {"white", blind::Colour::kWhite},
      {"autoregressive", blind::Colour::kAutoregressive},
      {"mixed", blind::Colour::kMixed},
      {"pink", blind::Colour::kPink}};
  app.add_option("--noise", order.options.colour, "of the torque; else drawn")
      ->transform(CLI::CheckedTransformer(colours));
  app.add_option("--seed", order.options.seed, "of the first case");
  app.add_option("--cases", order.count, "how many");
  app.add_option("--part", order.part, "this process makes cases part, part + parts, ...");
  app.add_option("--parts", order.parts, "how many processes share the work");
  app.add_flag("--quiet-sensors", quiet, "no noise: proves that a null is null");
  app.add_option("--arms", order.arms, "folder of the arms")->required();
  app.add_option("--out", order.out, "folder of the case folders")->required();
  app.add_option("--sealed", order.sealed, "folder of the manifest's entries")->required();
  CLI11_PARSE(app, argc, argv);
  order.options.noisy = !quiet;
  blind::make(order);
  return 0;
}
