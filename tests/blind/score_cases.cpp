// SPDX-License-Identifier: MIT
// blind_score: holds stored answers against the manifest.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "tests/blind/score.h"

namespace {

nlohmann::json read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return file ? nlohmann::json::parse(file, nullptr, false) : nlohmann::json();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Holds answers of the blind suite against the truth."};
  std::filesystem::path manifest, answers, cases;
  app.add_option("manifest", manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("answers", answers, "folder of NAME.json")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--lines", cases, "writes a line for each case");
  blind::Bounds bounds;
  app.add_option("--most-false-alarms", bounds.most_false_alarms, "share of the nulls");
  app.add_option("--most-confident-wrong", bounds.most_confident_wrong,
                 "share of single effects and foreign physics");
  app.add_option("--least-found", bounds.least_found,
                 "share of single effects, lambda 60 and more");
  app.add_option("--least-first", bounds.least_first, "share of these whose family is named first");
  CLI11_PARSE(app, argc, argv);
  const nlohmann::json truths = read(manifest);
  if (!truths.is_array()) {
    fmt::print(stderr, "{}: not an array of cases\n", manifest.string());
    return 1;
  }
  std::vector<blind::Judged> judged;
  for (const nlohmann::json& truth : truths) {
    judged.push_back(
        blind::judge(truth, read(answers / (truth["case"].get<std::string>() + ".json"))));
  }
  fmt::print("{}", blind::tables(judged));
  if (!cases.empty()) std::ofstream(cases) << blind::lines(judged);
  const std::string broken = blind::broken(judged, bounds);
  fmt::print(stderr, "{}", broken);
  return broken.empty() ? 0 : 3;
}
