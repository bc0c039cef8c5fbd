// SPDX-License-Identifier: MIT
#include "tests/blind/cases/measured_set.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

namespace blind {

namespace fs = std::filesystem;

void MeasuredSet::add_to(CLI::App& app) {
  app.add_option("manifest", manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--arms", arms, "folder of the arms")->required();
  app.add_option("--out", out, "JSON file to write")->required();
}

int write_measured(const MeasuredSet& set, const Kinds& kinds, unsigned jobs,
                   const std::function<nlohmann::json(const nlohmann::json&)>& measure) {
  std::ifstream file(set.manifest);
  const auto entries = nlohmann::json::parse(file);
  std::vector<nlohmann::json> measured(entries.size());
  std::atomic<std::size_t> next{0};
  std::atomic<int> failed{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size(); i = next++) {
      if (!kinds.contains(entries[i]["kind"])) continue;
      const std::string name = entries[i]["case"];
      try {
        measured[i] = measure(entries[i]);
        fmt::print(stderr, "{}: {}\n", name, measured[i].dump());
      } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
        ++failed;
      }
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < jobs; ++i) others.emplace_back(work);
  work();
  others.clear();
  nlohmann::json all = nlohmann::json::object();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!measured[i].is_null()) all[entries[i]["case"].get<std::string>()] = measured[i];
  }
  const fs::path unfinished = set.out.string() + "~";
  std::ofstream(unfinished) << all.dump(1) << '\n';
  fs::rename(unfinished, set.out);
  return failed;
}

}  // namespace blind
