// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>

#include "gen/tool/progress_line.h"
#include "runtime/control/linearised_error.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/tools/dynid/simulate/simulate_picture.h"
#include "runtime/tools/dynid/simulate/simulated_loop.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check_joints(const std::string& what, int found, const SimulatedRobot& robot) {
  if (found == robot.joints()) return;
  throw std::invalid_argument(
      fmt::format("{} has {} joints, {} has {}", what, found, robot.name, robot.joints()));
}

/// s, from the first sample to the last
double duration_of(const Trajectory& trajectory) {
  return std::max(1e-9, trajectory.time[trajectory.time.size() - 1] - trajectory.time[0]);
}

Eigen::MatrixXd temperatures(const SimulatedTemperature& temperature, const VectorXd& time,
                             int joints) {
  const VectorXd since = time.array() - time[0];
  return (temperature.start + temperature.rate * since.array()).matrix().replicate(1, joints);
}

/// What effects that do not act on the motion make of the recorded torque; its noise stays.
void record_effects(const RobotSource& source, const SimulatedRobot& plant, ClosedLoopRun& run) {
  const DescribedRobot robot = describe_robot(source, OpenParameters::kAsWritten);
  const Eigen::MatrixXd noise = run.measured.tau - run.truth.tau;
  // the rigid model moves with the links
  run.truth.tau =
      recorded_torque(robot, plant.recorded_effects, run.links, TorqueOfGains::kRecorded);
  run.measured.tau = run.truth.tau + noise;
}

/// A second encoder behind each gear that gives, with the steps of the first and without noise.
void add_link_encoders(const SimulatedRobot& plant, const ClosedLoopOptions& loop,
                       ClosedLoopRun& run) {
  const std::vector<int>& links = plant.plant.links;
  if (links.empty()) return;
  const Index samples = run.measured.samples();
  for (Recording* recording : {&run.measured, &run.truth}) {
    recording->q_link.setConstant(samples, plant.joints(),
                                  std::numeric_limits<double>::quiet_NaN());
  }
  for (std::size_t j = 0; j < links.size(); ++j) {
    const auto joint = static_cast<Index>(j);
    if (links[j] == static_cast<int>(j)) continue;  // rigid
    run.truth.q_link.col(joint) = run.links.q.col(joint);
    const double step = loop.encoder_step.size() > joint ? loop.encoder_step[joint] : 0;
    run.measured.q_link.col(joint) = run.links.q.col(joint);
    if (step > 0) {
      run.measured.q_link.col(joint) =
          (run.links.q.col(joint) / step).array().round().matrix() * step;
    }
  }
}

std::string conditions(const SimulateOptions& options, const Controller& controller,
                       const SimulatedRobot& plant, const ClosedLoopRun& run) {
  const Index samples = run.measured.samples();
  std::string text = fmt::format(
      "{}: {} joints, controller {}, bandwidth {:.6g} Hz, damping {:.6g}, {}\n", plant.name,
      plant.joints(), options.loop.controller, options.loop.bandwidth, options.loop.damping,
      options.loop.rate > 0 ? fmt::format("{:.6g} Hz", options.loop.rate) : "continuous");
  text +=
      fmt::format("friction compensation {}, delay {:.6g} s, seed {}\n",
                  controller.options().friction ? "on" : "off", options.loop.delay, options.seed);
  text += fmt::format(
      "{} samples, {:.6g} s; {} integration steps, {} reversals and {} releases located\n", samples,
      run.measured.time[samples - 1] - run.measured.time[0], run.counts.steps, run.counts.reversals,
      run.counts.releases);
  return text;
}

/// What computed torque survives, and how wrong the model is where the motion begins.
std::string robustness(const Controller& controller, const SimulatedRobot& model,
                       const SimulatedRobot& plant, const VectorXd& q) {
  const SurvivedError bound = largest_survived_error(controller.options().gains);
  const Eigen::MatrixXd E = inertia_error(mass_matrix_of(plant, q), mass_matrix_of(model, q));
  return fmt::format(
      "stable for every inertia error ||M^-1 M_model - I|| below {:.3g}; this model's is {:.3g} "
      "where the motion begins\n",
      bound.norm, Eigen::JacobiSVD<Eigen::MatrixXd>(E).singularValues()[0]);
}

std::string table(const SimulatedRobot& plant, const ClosedLoopRun& run, const VectorXd& limit) {
  const Tracking tracking = tracking_of(run);
  const VectorXd peak = run.measured.tau.cwiseAbs().colwise().maxCoeff();  // the file's
  std::string text =
      fmt::format("\n{:<13}{:>10}{:>10}{:>4}{:>12}{:>9}{:>4}{:>10}{:>8}\n", "joint", "rms error",
                  "worst", "", "peak torque", "limit", "", "saturated", "stuck");
  for (Index j = 0; j < plant.joints(); ++j) {
    const bool revolute = plant.revolute[static_cast<std::size_t>(j)];
    text += fmt::format(
        "{:<13}{:>10.4g}{:>10.4g} {:<3}{:>12.5g}{:>9} {:<3}{:>8.1f} %{:>6.1f} %\n",
        fmt::format("{} {}", j + 1, plant.joint_names[static_cast<std::size_t>(j)]).substr(0, 12),
        tracking.rms[j], tracking.worst[j], revolute ? "rad" : "m", peak[j],
        std::isfinite(limit[j]) ? fmt::format("{:.5g}", limit[j]) : "none", revolute ? "N m" : "N",
        100 * run.saturated_share[j], 100 * run.stuck_share[j]);
  }
  return text;
}

}  // namespace

int run_simulate(const ToolOptions& tool) {
  const SimulateOptions& options = tool.simulate;
  ProgressLine progress("dynid");
  const Trajectory trajectory = load_motion(options.trajectory, tool.map, options.robot);
  progress.show("equations of " + options.robot.path, 0, 1);
  const bool same = options.plant.empty();
  const EffectCatalogue catalogue = effect_catalogue(options.effects);
  const double duration = options.duration > 0 ? options.duration : duration_of(trajectory);
  const SimulatedTemperature temperature{
      options.temperature.front(),
      (options.temperature.back() - options.temperature.front()) / duration};
  const SimulatedRobot model = read_simulated_robot(
      options.robot, same ? RobotUse::kPlant : RobotUse::kController, catalogue, temperature);
  if (!same) progress.show("equations of " + options.plant.path, 0, 1);
  const SimulatedRobot plant =
      same ? model : read_simulated_robot(options.plant, RobotUse::kPlant, catalogue, temperature);
  if (!plant.remarks.empty()) progress.clear();
  for (const std::string& remark : plant.remarks) {
    std::cerr << fmt::format("{}: {}\n", same ? options.robot.path : options.plant.path, remark);
  }
  check_joints(options.trajectory, trajectory.joints(), model);
  check_joints("the plant " + plant.name, plant.joints(), model);

  // limits are the drive's: of the plant's file
  const VectorXd limit = torque_limit_of(options.loop, plant);
  ControllerOptions chosen = controller_options(options.loop, plant, trajectory.q.row(0));
  chosen.torque_limit = limit;
  Controller controller(model.control, chosen);
  std::optional<StartState> start;
  if (!options.start.empty()) {
    start = StartState{per_joint("--start", options.start, plant.joints()),
                       VectorXd::Zero(plant.joints())};
  }
  ClosedLoopOptions loop = loop_options(options.loop, plant.joints());
  loop.duration = options.duration;
  loop.torque_noise.deviation = per_joint("--torque-noise", options.torque_noise, plant.joints());
  loop.seed = options.seed;
  ClosedLoopRun run;
  try {
    run = simulate(plant.plant, controller, trajectory, loop, start, [&](double share) {
      progress.show("simulation", static_cast<std::size_t>(1000 * share), 1000);
    });
  } catch (const std::runtime_error& error) {
    progress.clear();
    std::cerr << "dynid: " << error.what() << "\n";
    if (!plant.plant.links.empty()) {
      std::cerr << "Gears give here: fast motion of a drive meets its rotor alone ('IA'), while "
                   "gains are those of rotor and links. A higher --rate or a lower --bandwidth may "
                   "help.\n";
    }
    return kCannotAnswer;
  }
  if (plant.reads_temperature)
    run.truth.temperature = run.measured.temperature = run.links.temperature =
        temperatures(temperature, run.truth.time, plant.joints());
  if (!plant.recorded_effects.empty()) {
    progress.show("effects of the recording", 0, 1);
    record_effects(same ? options.robot : options.plant, plant, run);
  }
  add_link_encoders(plant, loop, run);
  progress.clear();
  write_recording(run.measured, options.output);
  if (!options.truth.empty()) write_recording(run.truth, options.truth);
  std::cout << conditions(options, controller, plant, run)
            << (chosen.law == ControlLaw::kComputedTorque
                    ? robustness(controller, model, plant, trajectory.q.row(0))
                    : "")
            << table(plant, run, limit) << "\nwritten: " << options.output
            << (options.truth.empty() ? "" : ", " + options.truth) << "\n";
  if (!options.picture.empty()) {
    draw(picture_of(run, plant,
                    fmt::format("{}, controller {}", plant.name, options.loop.controller)),
         options.picture);
    std::cout << "written: " << options.picture << "\n";
  }
  return kDone;
}

}  // namespace dyngen::runtime
