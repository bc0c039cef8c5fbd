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
  return 0;
}
