// SPDX-License-Identifier: MIT
// blind_reach: what of the single effects of a set is in the equations that dynid makes of their
// recordings. Whoever knows the truth takes its torque off them; what the equations of both differ
// in is one column. A JSON object by case, numbers of Reach.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "tests/blind/cases/asked.h"
#include "tests/blind/cases/case.h"
#include "tests/blind/reach/reach.h"

namespace blind {
namespace {

namespace fs = std::filesystem;
namespace runtime = dyngen::runtime;

std::vector<runtime::MotionSource> read(const std::vector<fs::path>& paths) {
  runtime::MotionOptions options;
  options.stream_above = std::numeric_limits<std::size_t>::max();
  options.average_periods = false;
  std::vector<runtime::MotionSource> sources;
  for (const fs::path& path : paths) {
    sources.push_back(runtime::motion_of_file(path.string(), options));
  }
  return sources;
}

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
    left.emplace_back(torque_rows(log.recorded) - base_torque(machine, log));
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
  std::vector<Recording> training;
  for (std::size_t place = 0; place < redrawn.draft.training; ++place) {
    training.push_back(record_again(redrawn, place));
  }
  const std::vector<Eigen::MatrixXd> left =
      left_by_refit(redrawn.draft.machine, whitener_of(redrawn.draft, redrawn.deviation), training);
  fs::create_directories(folder);
  std::vector<fs::path> paths;
  for (std::size_t i = 0; i < training.size(); ++i) {
    training[i].log.recorded -= left[i];
    paths.push_back(folder / fmt::format("train{}.csv", i + 1));
    write_recording(training[i], false, paths.back().string());
  }
  auto sources = read(paths);
  fs::remove_all(folder);
  return sources;
}

Reach reach_of_case(const nlohmann::json& entry, const std::string& arms, const fs::path& folder,
                    const fs::path& scratch) {
  std::vector<fs::path> training, heldout;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    if (name.starts_with("train") && name != "train4.csv") training.push_back(file.path());
    if (name.starts_with("held")) heldout.push_back(file.path());
  }
  std::sort(training.begin(), training.end());
  std::sort(heldout.begin(), heldout.end());
  const dyngen::EffectCatalogue catalogue = runtime::effect_catalogue({});
  const runtime::DescribedRobot robot = runtime::describe_robot(
      (folder / "robot.robot").string(), runtime::OpenParameters::kAbsentRows);
  runtime::DiagnosisInput input;
  input.model = robot.linear;
  input.robot = runtime::effect_robot(robot);
  input.train = read(training);
  input.heldout = read(heldout);
  std::vector<runtime::MotionSource> all = input.train;
  all.insert(all.end(), input.heldout.begin(), input.heldout.end());
  input.hypotheses = runtime::competing_effects(robot, catalogue, all);
  return reach_of(input, without_truth(entry, arms, scratch));
}

int measure(const fs::path& manifest, const fs::path& arms, const fs::path& cases,
            const fs::path& out) {
  std::ifstream file(manifest);
  nlohmann::json all = nlohmann::json::object();
  int failed = 0;
  for (const auto& entry : nlohmann::json::parse(file)) {
    if (entry["kind"] != "single") continue;
    const std::string name = entry["case"];
    try {
      const Reach reach =
          reach_of_case(entry, arms.string(), cases / name, out.string() + "." + name);
      all[name] = {{"lambda", reach.lambda},
                   {"seen", reach.seen},
                   {"found", reach.found},
                   {"needed", reach.needed}};
      fmt::print(stderr, "{}: {:.1f}, by the noise that is seen {:.1f}, found {:.1f} of {:.1f}\n",
                 name, reach.lambda, reach.seen, reach.found, reach.needed);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}: {}\n", name, error.what());
      ++failed;
    }
  }
  const fs::path unfinished = out.string() + "~";
  std::ofstream(unfinished) << all.dump(1) << '\n';
  fs::rename(unfinished, out);
  return failed;
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"What of single effects is in the equations of a diagnosis."};
  std::filesystem::path manifest, arms, cases, out;
  app.add_option("manifest", manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--arms", arms, "folder of the arms")->required();
  app.add_option("--cases", cases, "folder of the cases")->required();
  app.add_option("--out", out, "JSON file to write")->required();
  CLI11_PARSE(app, argc, argv);
  return blind::measure(manifest, arms, cases, out) == 0 ? 0 : 1;
}
