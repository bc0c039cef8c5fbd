// SPDX-License-Identifier: MIT
// blind_reach: what of the single effects of a set, and of foreign physics, is in the equations
// that dynid makes of their recordings. Whoever knows the truth takes its torque off them; what the
// equations of both differ in is one column. A JSON object by case, numbers of Reach.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "tests/blind/cases/asked.h"
#include "tests/blind/cases/case.h"
#include "tests/blind/cases/measured_set.h"
#include "tests/blind/dynid/case_input.h"
#include "tests/blind/reach/reach.h"

namespace blind {
namespace {

namespace fs = std::filesystem;
namespace runtime = dyngen::runtime;

/// What of the left-out torque a refit of all base parameters leaves, (N x j) of each recording. A
/// refit absorbs the rest in the equations too, but by estimates that noise of positions moves.
std::vector<Eigen::MatrixXd> left_by_refit(const Machine& machine, const Whitener& whitener,
                                           const std::vector<Recording>& training) {
  std::vector<Eigen::MatrixXd> columns, whitened, left;
  std::vector<Eigen::VectorXd> rows;
  for (const Recording& each : training) {
    const Log& log = each.log;
    const RestWhitener white(whitener, log);
    columns.push_back(base_columns(machine, log));
    whitened.push_back(white(columns.back()));
    left.emplace_back(torque_rows(known_torque(each)) - base_torque(machine, log));
    rows.emplace_back(white(left.back()));
  }
  const Eigen::VectorXd absorbed = Refit(std::move(whitened)).solve(rows);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Eigen::VectorXd rest = left[i] - columns[i] * absorbed;
    const Log& log = training[i].log;
    left[i] =
        Eigen::Map<const Eigen::MatrixXd>(rest.data(), log.recorded.rows(), log.recorded.cols());
  }
  return left;
}

/// The fitted recordings less what was left out, noise and all else the same.
std::vector<runtime::MotionSource> without_truth(const nlohmann::json& entry,
                                                 const std::string& arms, const fs::path& folder) {
  const Redrawn redrawn = redraw(entry, arms);
  std::vector<Recording> training = training_again(redrawn);
  const std::vector<Eigen::MatrixXd> left =
      left_by_refit(redrawn.draft.machine, whitener_of(redrawn.draft, redrawn.deviation), training);
  fs::create_directories(folder);
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < training.size(); ++i) {
    training[i].log.recorded -= left[i];
    paths.push_back((folder / fmt::format("train{}.csv", i + 1)).string());
    write_recording(training[i], redrawn.draft.logger, false, paths.back());
  }
  auto sources = read_recordings(paths);
  fs::remove_all(folder);
  return sources;
}

/// Files of a case that begin with a word, in their order, without the one that was asked for
/// later.
std::vector<std::string> files_of(const fs::path& folder, const std::string& word) {
  std::vector<std::string> files;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    if (name.starts_with(word)) files.push_back(file.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

nlohmann::json measured(const nlohmann::json& entry, const MeasuredSet& set,
                        const fs::path& cases) {
  const std::string name = entry["case"];
  const fs::path folder = cases / name;
  const auto input = case_input((folder / "robot.robot").string(), files_of(folder, "train"),
                                files_of(folder, "held"));
  const Reach reach =
      reach_of(input, without_truth(entry, set.arms.string(), set.out.string() + "." + name));
  return {{"lambda", reach.lambda},
          {"seen", reach.seen},
          {"found", reach.found},
          {"needed", reach.needed},
          {"repeating", reach.repeating}};
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"What of single effects and foreign physics is in the equations of a diagnosis."};
  blind::MeasuredSet set;
  set.add_to(app);
  std::filesystem::path cases;
  app.add_option("--cases", cases, "folder of the cases")->required();
  CLI11_PARSE(app, argc, argv);
  const auto measure = [&](const nlohmann::json& entry) {
    return blind::measured(entry, set, cases);
  };
  // one at once: a diagnosis has threads of its own
  return blind::write_measured(set, {"single", "foreign"}, 1, measure) == 0 ? 0 : 1;
}
