// SPDX-License-Identifier: MIT
// blind_answer: gives cases the one more recording that was asked for. For every NAME.csv among
// the motions, the machine of case NAME moves along it, and asked.csv stands beside the others.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/blind/cases/asked.h"

namespace blind {
namespace {

namespace fs = std::filesystem;

struct Order {
  fs::path manifest, asked, cases, arms;
  std::size_t part = 0, parts = 1;
};

/// @return  how many of the recordings could not be made
int answer(const Order& order) {
  std::ifstream file(order.manifest);
  const auto entries = nlohmann::json::parse(file);
  int failed = 0;
  for (std::size_t i = order.part; i < entries.size(); i += order.parts) {
    const std::string name = entries[i]["case"];
    const fs::path motion = order.asked / (name + ".csv");
    if (!fs::exists(motion)) continue;
    try {
      const Redrawn redrawn = redraw(entries[i], order.arms);
      const Recording made = record_along(redrawn, read_motion(motion, redrawn.draft.arm.joints()));
      const fs::path target = order.cases / name / "asked.csv", unfinished = target.string() + "~";
      write_recording(made, redrawn.draft.logger, false, unfinished);
      fs::rename(unfinished, target);
      fmt::print("{}: {:.1f} s\n", name, static_cast<double>(made.log.q.rows()) / made.log.rate);
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "{}: {}\n", name, error.what());
      ++failed;
    }
    std::fflush(stdout);
  }
  return failed;
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Gives cases of the blind suite the recordings that were asked for."};
  blind::Order order;
  app.add_option("manifest", order.manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--asked", order.asked, "folder of NAME.csv, the motions")->required();
  app.add_option("--cases", order.cases, "folder of the case folders")->required();
  app.add_option("--arms", order.arms, "folder of the arms")->required();
  app.add_option("--part", order.part, "this process makes cases part, part + parts, ...");
  app.add_option("--parts", order.parts, "how many processes share the work");
  CLI11_PARSE(app, argc, argv);
  return blind::answer(order) == 0 ? 0 : 1;
}
