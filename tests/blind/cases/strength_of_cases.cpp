// SPDX-License-Identifier: MIT
// blind_strength: what of the single effects of a set is left to who does not know what friction
// does in the instants in which joints stop, turn and let go. A JSON object by case: "lambda", all
// of it, which the manifests up to the set thaw have by the noise of three recordings alone;
// "instants", and of that "slow", below 40 Hz.
#include <CLI/CLI.hpp>
#include <thread>

#include "tests/blind/cases/asked.h"
#include "tests/blind/cases/instants.h"
#include "tests/blind/cases/measured_set.h"

namespace blind {
namespace {

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
        torque_rows(known_torque(each)) - base_torque(redrawn.draft.machine, each.log);
    left_out.emplace_back(white(left));
  }
  return squares(Refit(std::move(columns)).residual(left_out));
}

nlohmann::json strength_of(const nlohmann::json& entry, const std::string& arms) {
  const Redrawn redrawn = redraw(entry, arms);
  const std::vector<Recording> training = training_again(redrawn);
  const Whitener noise = whitener_of(redrawn.draft, redrawn.deviation);
  return {{"lambda", lambda_of<RestWhitener>(redrawn, training, noise)},
          {"instants", lambda_of<InstantWhitener>(redrawn, training, noise)},
          {"slow", lambda_of<InstantWhitener>(redrawn, training, noise, kSlow)}};
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Strength of single effects beside friction that may do anything at instants."};
  blind::MeasuredSet set;
  set.add_to(app);
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("--jobs", jobs, "how many threads share the work")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const auto measure = [&](const nlohmann::json& entry) {
    return blind::strength_of(entry, set.arms.string());
  };
  return blind::write_measured(set, {"single"}, jobs, measure) == 0 ? 0 : 1;
}
