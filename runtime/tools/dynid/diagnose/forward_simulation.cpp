// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/forward_simulation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/recordings/spline.h"
#include "runtime/tools/dynid/diagnose/improved_file.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "runtime/tools/dynid/simulate/simulated_loop.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kPostures = 200;  // of a motion at which the mass matrix is looked at

/// A motion that is simulated, and the recording beside it.
struct Part {
  std::string name;
  Motion recorded;
  Trajectory reference;
  std::optional<StartState> start;  ///< none: where the reference begins
};

/// One robot of the comparison.
struct Candidate {
  std::string words;  ///< "the model alone"
  RobotFile file;
};

std::vector<Part> parts_of(const ForwardTask& task) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < task.recordings.size(); ++i) {
    const MotionSource& source = task.recordings[i];
    source.pieces([&](const StreamPiece& piece) {
      const Motion& motion = piece.motion;
      if (motion.samples() < 2) return;
      Part part{source.name, motion, {motion.time, motion.q, motion.dq, motion.ddq}, {}};
      if (task.commanded.empty()) {
        part.start = StartState{motion.q.row(0), motion.dq.row(0)};
      } else {
        part.reference = task.commanded[i];
      }
      parts.push_back(std::move(part));
    });
  }
  return parts;
}

void check_reference(const Part& part) {
  const Trajectory& reference = part.reference;
  if (reference.joints() != part.recorded.joints()) {
    throw std::invalid_argument(fmt::format("--commanded: found {} joints, {} has {}",
                                            reference.joints(), part.name, part.recorded.joints()));
  }
  const double from = reference.time[0], to = reference.time[reference.samples() - 1];
  const double first = part.recorded.time[0],
               last = part.recorded.time[part.recorded.samples() - 1];
  const double step = part.recorded.sample_time;
  if (first > from - step && last < to + step) return;
  throw std::invalid_argument(
      fmt::format("--commanded: found a motion from {:.6g} to {:.6g} s, expected one that covers "
                  "{} from {:.6g} to {:.6g} s, in the same time",
                  from, to, part.name, first, last));
}

/// Where a robot cannot be accelerated; empty: nowhere.
std::string why_not_simulable(const SimulatedRobot& robot, const std::string& words,
                              const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    if (Eigen::LLT<MatrixXd>(mass_matrix_of(robot, part.reference.q.row(0))).info() !=
        Eigen::Success) {
      return fmt::format(
          "The mass matrix of {} is not positive definite where the motion of {} begins: "
          "parameters that no body has cannot be simulated",
          words, part.name);
    }
    const Index step = std::max<Index>(1, part.recorded.samples() / kPostures);
    for (Index k = 0; k < part.recorded.samples(); k += step) {
      const Eigen::LLT<MatrixXd> factor(mass_matrix_of(robot, part.recorded.q.row(k)));
      if (factor.info() == Eigen::Success) continue;
      return fmt::format(
          "The mass matrix of {} is not positive definite where {} is at {:.4g} s: parameters that "
          "no body has cannot be simulated",
          words, part.name, part.recorded.time[k]);
    }
  }
  return {};
}

/// Sums of squares of simulated less recorded.
struct Squares {
  VectorXd position, torque;
  double samples = 0;
};

/// What the simulated machine's sensors would have recorded as torque.
MatrixXd torque_of(const SimulatedRobot& plant, const DescribedRobot& described,
                   const Recording& links) {
  if (plant.recorded_effects.empty()) return links.tau;
  return recorded_torque(described, plant.recorded_effects, links, TorqueOfGains::kRecorded);
}

void add_errors(const Part& part, const ClosedLoopRun& run, const MatrixXd& torque, double from,
                Squares& squares) {
  const VectorXd& time = part.recorded.time;
  const double last = run.truth.time[run.truth.samples() - 1];
  Index first = 0, end = time.size();
  while (first < end && time[first] < from) ++first;
  while (end > first && time[end - 1] > last) --end;
  if (first == end) return;
  const VectorXd at = time.segment(first, end - first);
  const MatrixXd q = interpolate_spline(run.truth.time, run.truth.q, at);
  const MatrixXd tau = interpolate_linear(run.truth.time, torque, at);
  squares.position +=
      (q - part.recorded.q.middleRows(first, end - first)).colwise().squaredNorm().transpose();
  squares.torque +=
      (tau - part.recorded.tau.middleRows(first, end - first)).colwise().squaredNorm().transpose();
  squares.samples += static_cast<double>(end - first);
}

SimulatedTemperature temperature_of(const std::vector<Part>& parts) {
  const Motion& motion = parts.front().recorded;
  if (motion.temperature.size() == 0) return {};
  const Index last = motion.samples() - 1;
  const double start = motion.temperature.row(0).mean(), end = motion.temperature.row(last).mean();
  return {start, (end - start) / (motion.time[last] - motion.time[0])};
}

/// Base parameters of the model alone, fitted.
VectorXd parameters_alone(const Diagnosis& diagnosis) {
  VectorXd beta(static_cast<Index>(diagnosis.base_parameters.size()));
  for (Index i = 0; i < beta.size(); ++i) {
    beta[i] = diagnosis.base_parameters[static_cast<std::size_t>(i)].before;
  }
  return beta;
}

/// Runs the robots of one comparison.
class ForwardSimulation {
 public:
  ForwardSimulation(const ForwardTask& task, const EffectCatalogue& catalogue,
                    const std::function<void(double)>& tell)
      : task_(task), catalogue_(catalogue), tell_(tell), parts_(parts_of(task)) {
    if (parts_.empty()) throw std::invalid_argument("there is no recording to compare with");
    for (const Part& part : parts_) check_reference(part);
    temperature_ = temperature_of(parts_);
  }

  ForwardComparison compare(const DiagnosisReport& report, const DescribedRobot& robot) {
    const VectorXd beta = parameters_alone(report.diagnosis);
    const std::string alone = identified_text(robot, nearest_standard(robot, beta), {});
    const Candidate before{"the model alone", parse_robot_file(alone, robot.file.file_name)};
    const Candidate after{"the model with the findings",
                          parse_robot_file(improved_text(report, robot), robot.file.file_name)};
    ForwardComparison result;
    for (const Part& part : parts_) {
      result.seconds += part.recorded.time[part.recorded.samples() - 1] - part.recorded.time[0];
    }
    result.how = fmt::format(
        "controller {}, {:.3g} Hz, on {}", task_.loop.controller, task_.loop.bandwidth,
        task_.commanded.empty() ? "the motion that was recorded" : "the motion that was commanded");
    const std::optional<SimulatedRobot> first = plant_of(before, result.before.why_not);
    const std::optional<SimulatedRobot> second = plant_of(after, result.after.why_not);
    if (!first && !second) return result;
    const SimulatedRobot& tuned = second ? *second : *first;
    const ControlModel model =
        task_.controller_model.empty()
            ? simulated_robot(before.file, RobotUse::kController, catalogue_).control
            : read_simulated_robot(task_.controller_model, RobotUse::kController, catalogue_)
                  .control;
    if (model.joints != tuned.joints()) {
      throw std::invalid_argument(fmt::format("{} has {} joints, {} has {}",
                                              task_.controller_model.path, model.joints, tuned.name,
                                              tuned.joints()));
    }
    if (first) result.before = errors_of(before, *first, tuned, model, 0);
    const EffectPoint& point = report.diagnosis.fit.point;
    const bool same = point.effects.empty() && point.beta == beta;
    if (same) result.after = result.before;
    if (second && !same) result.after = errors_of(after, *second, tuned, model, 0.5);
    return result;
  }

 private:
  std::optional<SimulatedRobot> plant_of(const Candidate& candidate, std::string& why_not) const {
    try {
      SimulatedRobot plant =
          simulated_robot(candidate.file, RobotUse::kPlant, catalogue_, temperature_);
      why_not = why_not_simulable(plant, candidate.words, parts_);
      if (why_not.empty()) return plant;
    } catch (const ModelError& error) {
      const std::string all = error.what();
      why_not =
          fmt::format("{} cannot be simulated: {}", candidate.words, all.substr(0, all.find('\n')));
    }
    return std::nullopt;
  }

  SimulatedError errors_of(const Candidate& candidate, const SimulatedRobot& plant,
                           const SimulatedRobot& tuned, const ControlModel& model,
                           double done) const {
    const DescribedRobot described = describe_robot(candidate.file, OpenParameters::kAsWritten);
    const int n = plant.joints();
    Squares squares{VectorXd::Zero(n), VectorXd::Zero(n), 0};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      ControllerOptions options = controller_options(task_.loop, tuned, part.reference.q.row(0));
      options.torque_limit = torque_limit_of(task_.loop, plant);
      Controller controller(model, options);
      const double share = 0.5 / static_cast<double>(parts_.size());
      try {
        const ClosedLoopRun run =
            simulate(plant.plant, controller, part.reference, loop_options(task_.loop, n),
                     part.start, [&](double own) {
                       if (tell_) tell_(done + share * (static_cast<double>(i) + own));
                     });
        const double settled = run.truth.time[0] + 1 / task_.loop.bandwidth;
        add_errors(part, run, torque_of(plant, described, run.links), settled, squares);
      } catch (const std::runtime_error& error) {
        return {{}, {}, fmt::format("{} on {}: {}", candidate.words, part.name, error.what())};
      }
    }
    if (squares.samples == 0) {
      return {{}, {}, "The recordings end before the simulated loop has settled"};
    }
    return {(squares.position / squares.samples).cwiseSqrt(),
            (squares.torque / squares.samples).cwiseSqrt(),
            {}};
  }

  const ForwardTask& task_;
  const EffectCatalogue& catalogue_;
  const std::function<void(double)>& tell_;
  std::vector<Part> parts_;
  SimulatedTemperature temperature_;
};

}  // namespace

ForwardComparison compare_forward(const DiagnosisReport& report, const DescribedRobot& robot,
                                  const EffectCatalogue& catalogue, const ForwardTask& task,
                                  const std::function<void(double)>& tell) {
  return ForwardSimulation(task, catalogue, tell).compare(report, robot);
}

}  // namespace dyngen::runtime
