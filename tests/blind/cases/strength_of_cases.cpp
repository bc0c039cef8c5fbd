// SPDX-License-Identifier: MIT
// blind_strength: what of the single effects of a set is left to who does not know what friction
// does in the instants in which joints stop, turn and let go. A JSON object by case: "lambda", all
// of it, which the manifests up to the set thaw have by the noise of three recordings alone;
// "instants", and of that "slow", below 40 Hz.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/blind/cases/asked.h"
#include "tests/blind/cases/instants.h"

namespace blind {
namespace {

namespace fs = std::filesystem;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSlow = 40;  // Hz: about what equations of filtered positions reach

/// @tparam White  whitens the equations of a recording, less what is not known of them
template <class White>
double lambda_of(const Redrawn& redrawn, const std::vector<Recording>& training,
                 const Whitener& noise, double below = 0) {
  Whitener whitener = noise;
  if (below > 0) whitener.stop_above(below, redrawn.draft.rate);
  std::vector<MatrixXd> columns;
  std::vector<VectorXd> left_out;
  for (const Recording& each : training) {
    const White white(whitener, each.log);
    columns.push_back(white(base_columns(redrawn.draft.machine, each.log)));
    const MatrixXd left =
        torque_rows(each.log.recorded) - base_torque(redrawn.draft.machine, each.log);
    left_out.emplace_back(white(left));
  }
  return squares(Refit(std::move(columns)).residual(left_out));
}

nlohmann::json strength_of(const nlohmann::json& entry, const std::string& arms) {
  const Redrawn redrawn = redraw(entry, arms);
  std::vector<Recording> training;
  for (std::size_t place = 0; place < redrawn.draft.training; ++place) {
    training.push_back(record_again(redrawn, place));
  }
  const Whitener noise = whitener_of(redrawn.draft, redrawn.deviation);
  return {{"lambda", lambda_of<RestWhitener>(redrawn, training, noise)},
          {"instants", lambda_of<InstantWhitener>(redrawn, training, noise)},
          {"slow", lambda_of<InstantWhitener>(redrawn, training, noise, kSlow)}};
}

int measure(const fs::path& manifest, const fs::path& arms, const fs::path& out, unsigned jobs) {
  std::ifstream file(manifest);
  const auto entries = nlohmann::json::parse(file);
  std::vector<nlohmann::json> strengths(entries.size());
  std::atomic<std::size_t> next{0};
  std::atomic<int> failed{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size(); i = next++) {
      if (entries[i]["kind"] != "single") continue;
      const std::string name = entries[i]["case"];
      try {
        strengths[i] = strength_of(entries[i], arms);
        fmt::print(stderr, "{}: {:.1f}, {:.1f} without instants, below {:.0f} Hz {:.1f}\n", name,
                   strengths[i]["lambda"].get<double>(), strengths[i]["instants"].get<double>(),
                   kSlow, strengths[i]["slow"].get<double>());
      } catch (const std::runtime_error& error) {
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
    if (!strengths[i].is_null()) all[entries[i]["case"].get<std::string>()] = strengths[i];
  }
  const fs::path unfinished = out.string() + "~";
  std::ofstream(unfinished) << all.dump(1) << '\n';
  fs::rename(unfinished, out);
  return failed;
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Strength of single effects beside friction that may do anything at instants."};
  std::filesystem::path manifest, arms, out;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("manifest", manifest, "JSON array of all cases")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--arms", arms, "folder of the arms")->required();
  app.add_option("--out", out, "JSON file to write")->required();
  app.add_option("--jobs", jobs, "how many threads share the work")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  return blind::measure(manifest, arms, out, jobs) == 0 ? 0 : 1;
}
