// SPDX-License-Identifier: MIT
// blind_score: holds stored answers against the manifest.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/blind/score/baselines.h"
#include "tests/blind/score/change.h"
#include "tests/blind/score/figures.h"
#include "tests/blind/score/score.h"
#include "tests/blind/score/second.h"

namespace {

nlohmann::json read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return file ? nlohmann::json::parse(file, nullptr, false) : nlohmann::json();
}

void write(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path unfinished = path.string() + "~";
  std::ofstream(unfinished) << text;
  std::filesystem::rename(unfinished, path);
}

/// Of real recordings: each is held against the same recording as it is.
int score_changes(const nlohmann::json& entries, const std::filesystem::path& answers) {
  const auto answer = [&](const nlohmann::json& entry) {
    return read(answers / (entry["case"].get<std::string>() + ".json"));
  };
  std::vector<blind::Change> changes;
  for (const nlohmann::json& entry : entries) {
    if (entry["added"].is_null()) continue;
    const auto plain = std::find_if(entries.begin(), entries.end(), [&](const auto& other) {
      return other["added"].is_null() && other["recording"] == entry["recording"];
    });
    if (plain == entries.end()) {
      fmt::print(stderr, "{}: the recording as it is is no case\n",
                 entry["recording"].get<std::string>());
      return 1;
    }
    changes.push_back(blind::judge_change(entry, answer(*plain), answer(entry)));
  }
  fmt::print("{}", blind::change_table(changes));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Holds answers of the blind suite against the truth."};
  std::filesystem::path manifest, answers, cases, pictures, asked, second, baselines, strengths,
      reach;
  app.add_option("manifest", manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("answers", answers, "folder of NAME.json")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--lines", cases, "writes a line for each case");
  app.add_option("--figures", pictures, "writes what the pictures show into this folder");
  auto* again = app.add_option("--second", second,
                               "folder of NAME.json, answers with one more recording where names "
                               "were left");
  app.add_option("--asked", asked, "folder of NAME.json, what was asked for")->needs(again);
  app.add_option("--baselines", baselines, "folder of what simpler methods answered")
      ->check(CLI::ExistingDirectory);
  app.add_option("--strengths", strengths, "what blind_strength measured")
      ->check(CLI::ExistingFile);
  app.add_option("--reach", reach, "what blind_reach measured")->check(CLI::ExistingFile);
  bool real = false;
  app.add_flag("--real", real,
               "cases are real recordings with something added: how answers change");
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
  if (real) return score_changes(truths, answers);
  std::vector<blind::Judged> judged;
  for (const nlohmann::json& truth : truths) {
    judged.push_back(
        blind::judge(truth, read(answers / (truth["case"].get<std::string>() + ".json"))));
  }
  if (!strengths.empty()) {
    const nlohmann::json measured = read(strengths);
    for (blind::Judged& each : judged) {
      if (!measured.contains(each.name)) continue;
      each.instants = measured[each.name].at("instants");
      each.slow = measured[each.name].at("slow");
      each.again = measured[each.name].at("lambda");
    }
  }
  if (!reach.empty()) {
    const nlohmann::json measured = read(reach);
    for (blind::Judged& each : judged) {
      if (!measured.contains(each.name)) continue;
      each.reach = measured[each.name].at("lambda");
      each.repeating = measured[each.name].at("repeating");
    }
  }
  fmt::print("{}", blind::tables(judged));
  if (!baselines.empty()) {
    std::vector<blind::JudgedBaseline> rows;
    for (const blind::Judged& each : judged) rows.push_back(blind::as_baseline(each));
    for (const blind::Judged& each : judged) {
      const auto own = blind::judge_baselines(each.truth, read(baselines / (each.name + ".json")));
      rows.insert(rows.end(), own.begin(), own.end());
    }
    fmt::print("\n{}", blind::baseline_table(rows));
  }
  std::string lines = blind::lines(judged);
  if (!second.empty()) {
    std::vector<blind::Second> seconds;
    for (const blind::Judged& each : judged) {
      if (!blind::leaves_names(each.answer)) continue;
      const std::string file = each.name + ".json";
      seconds.push_back(blind::judge_second(each, read(second / file), read(asked / file)));
    }
    fmt::print("\n{}", blind::second_table(seconds));
    lines += blind::second_lines(seconds);
  }
  if (!cases.empty()) write(cases, lines);
  if (!pictures.empty()) {
    std::filesystem::create_directories(pictures);
    for (const auto& [name, text] : blind::figures(judged)) write(pictures / name, text);
  }
  const std::string broken = blind::broken(judged, bounds);
  fmt::print(stderr, "{}", broken);
  return broken.empty() ? 0 : 3;
}
