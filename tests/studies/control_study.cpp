// SPDX-License-Identifier: MIT
// The tables of docs/howto/control_and_simulation.md, in Markdown.
//
//   control_study [rates|errors|geared|stability|all]
//   control_study regions > regions.csv
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "runtime/control/linearised_error.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"
#include "tests/studies/changed_file.h"
#include "tests/studies/study_robot.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::ControlLaw;
using runtime::RobotUse;
using runtime::SimulatedRobot;

constexpr double kBandwidth = 3;  // Hz
constexpr unsigned kSeed = 1;

std::string in_project(const std::string& path) {
  return std::string(DYNGEN_SOURCE_DIR "/") + path;
}

runtime::Trajectory study_trajectory(const MotionLimits& limits, double seconds) {
  const FourierMotion motion = random_motion(limits, 0.1, {1, 2, 3, 5}, 10, kSeed);
  const double step = 1e-3;
  const Index samples = 1 + std::lround(seconds / step), n = motion.centre.size();
  runtime::Trajectory trajectory;
  trajectory.time.resize(samples);
  for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, n);
  for (Index k = 0; k < samples; ++k) {
    trajectory.time[k] = static_cast<double>(k) * step;
    const FourierMotion::State state = motion.at(trajectory.time[k]);
    trajectory.q.row(k) = state.q;
    trajectory.dq.row(k) = state.dq;
    trajectory.ddq.row(k) = state.ddq;
  }
  return trajectory;
}

MatrixXd mass_matrix_of(const runtime::PlantModel& plant, const VectorXd& q) {
  MatrixXd M(plant.joints, plant.joints);
  plant.mass_matrix(q.data(), M.data());
  return M;
}

/// rms over samples and joints, rad.
double tracking_error(const SimulatedRobot& plant, const runtime::ControlModel& model,
                      ControlLaw law, const VectorXd& inertia,
                      const runtime::Trajectory& trajectory,
                      const runtime::ClosedLoopOptions& loop) {
  runtime::ControllerOptions options;
  options.law = law;
  options.gains = law == ControlLaw::kComputedTorque
                      ? runtime::acceleration_gains(plant.joints(), kBandwidth, 1)
                      : runtime::torque_gains(inertia, kBandwidth, 1);
  options.friction = law == ControlLaw::kFeedforward || law == ControlLaw::kComputedTorque;
  runtime::Controller controller(model, options);
  const auto run = runtime::simulate(plant.plant, controller, trajectory, loop);
  return std::sqrt(runtime::tracking_of(run).rms.squaredNorm() / plant.joints());
}

/// Sensors of an industrial arm at 1 kHz.
runtime::ClosedLoopOptions usual_loop(Index joints) {
  runtime::ClosedLoopOptions loop;
  loop.encoder_step = VectorXd::Constant(joints, 2 * std::numbers::pi / (1 << 17));
  loop.velocity_cutoff_hz = 100;
  return loop;
}

void rates() {
  std::printf(
      "| robot | continuous | 10 kHz | 1 kHz | 1 kHz, encoder | 200 Hz "
      "|\n|---|---|---|---|---|---|\n");
  for (const char* name : {"puma3", "ur10e", "panda"}) {
    const StudyRobot study = study_robot(name);
    // computed torque with the true model; no Coulomb friction, which is compensated but for a band
    const ChangedFile file("tests/studies/robots/" + std::string(name) + ".robot", {"Fs"});
    const SimulatedRobot robot = runtime::read_simulated_robot(file.path(), RobotUse::kPlant);
    const auto trajectory = study_trajectory(study.limits, 5);
    const auto error = [&](runtime::ClosedLoopOptions loop) {
      return tracking_error(robot, robot.control, ControlLaw::kComputedTorque, {}, trajectory,
                            loop);
    };
    runtime::ClosedLoopOptions loop;
    loop.continuous = true;
    std::string row = fmt::format("| {} | {:.1e}", name, error(loop));
    loop.continuous = false;
    loop.rate = 10000;
    row += fmt::format(" | {:.1e}", error(loop));
    row += fmt::format(" | {:.1e}", error({}));
    row += fmt::format(" | {:.1e}", error(usual_loop(robot.joints())));
    loop.rate = 200;
    std::printf("%s | %.1e |\n", row.c_str(), error(loop));
  }
}

/// Every link's inertia and friction wrong by `size`, up or down at random.
NumericRobot wrong_model(NumericRobot robot, double size, std::mt19937_64& random) {
  for (NumericJoint& joint : robot.joints) {
    const double factor = 1 + (random() % 2 == 0 ? size : -size);
    for (double& value : joint.inertial) value *= factor;
    const double loss = 1 + (random() % 2 == 0 ? size : -size);
    joint.IA *= factor;
    joint.Fs *= loss;
    joint.Fv *= loss;
    joint.off *= loss;
  }
  return robot;
}

void errors() {
  constexpr int kModels = 5;
  for (const char* name : {"puma3", "ur10e"}) {
    const StudyRobot study = study_robot(name);
    const std::string file = "tests/studies/robots/" + std::string(name) + ".robot";
    const SimulatedRobot plant = runtime::read_simulated_robot(in_project(file), RobotUse::kPlant);
    const NumericRobot truth = numeric_robot(read_model(file));
    const auto trajectory = study_trajectory(study.limits, 10);
    const VectorXd inertia = mass_matrix_of(plant.plant, study.limits.centre).diagonal();
    std::printf(
        "\n%s, rms tracking error in mrad, median of %d models (seed %u)\n\n"
        "| model error | pd | pd + gravity | ff | ct |\n|---|---|---|---|---|\n",
        name, kModels, kSeed);
    for (const double size : {0.0, 0.05, 0.1, 0.2, 0.5}) {
      std::string row = fmt::format("| {:.0f} %", 100 * size);
      for (const ControlLaw law : {ControlLaw::kPd, ControlLaw::kGravity, ControlLaw::kFeedforward,
                                   ControlLaw::kComputedTorque}) {
        std::mt19937_64 random(kSeed);
        std::vector<double> found;
        for (int k = 0; k < kModels; ++k) {
          const NumericRobot model = wrong_model(truth, size, random);
          found.push_back(1000 * tracking_error(plant, numeric_control(model), law, inertia,
                                                trajectory, usual_loop(plant.joints())));
        }
        std::sort(found.begin(), found.end());
        row += fmt::format(" | {:.2f}", found[kModels / 2]);
      }
      std::printf("%s |\n", row.c_str());
    }
  }
}

/// What a feedforward of single joints knows: a constant inertia of each joint, and gravity.
runtime::ControlModel joint_by_joint(runtime::ControlModel model, const VectorXd& inertia) {
  model.rigid = [gravity = model.gravity, inertia](const double* q, const double*,
                                                   const double* ddq, double* tau) {
    gravity(q, tau);
    for (Index j = 0; j < inertia.size(); ++j) tau[j] += inertia[j] * ddq[j];
  };
  return model;
}

MotionLimits puma_limits() {
  const auto six = [](double a, double b, double c, double d, double e, double f) {
    return (VectorXd(6) << a, b, c, d, e, f).finished();
  };
  return {six(0, -0.8, 0.5, 0, 0.5, 0), six(1.8, 1.2, 1.4, 2, 1.5, 2),
          six(1.4, 1.0, 1.6, 2.5, 2.5, 2.5), six(4, 3, 5, 8, 8, 8)};
}

void geared() {
  std::printf(
      "\n| Puma 560 | pd | pd + gravity | ff, joint by joint | ff | ct "
      "|\n|---|---|---|---|---|---|\n");
  struct Variant {
    const char* name;
    std::vector<std::string> left_out;
  };
  const std::vector<Variant> variants = {{"geared (the file)", {}},
                                         {"rotors, no friction", {"Fs", "Fv", "off"}},
                                         {"direct drive: neither", {"Fs", "Fv", "off", "IA"}}};
  const MotionLimits limits = puma_limits();
  const auto trajectory = study_trajectory(limits, 10);
  for (const Variant& variant : variants) {
    const ChangedFile file("robots/puma560.robot", variant.left_out);
    const SimulatedRobot plant = runtime::read_simulated_robot(file.path(), RobotUse::kPlant);
    const VectorXd inertia = mass_matrix_of(plant.plant, limits.centre).diagonal();
    std::string row = fmt::format("| {}", variant.name);
    const auto add = [&](ControlLaw law, const runtime::ControlModel& model) {
      row += fmt::format(" | {:.2f}", 1000 * tracking_error(plant, model, law, inertia, trajectory,
                                                            usual_loop(plant.joints())));
    };
    add(ControlLaw::kPd, plant.control);
    add(ControlLaw::kGravity, plant.control);
    add(ControlLaw::kFeedforward, joint_by_joint(plant.control, inertia));
    add(ControlLaw::kFeedforward, plant.control);
    add(ControlLaw::kComputedTorque, plant.control);
    std::printf("%s |\n", row.c_str());
  }
}

void stability() {
  std::printf(
      "\n| damping | largest \\|\\|E\\|\\| survived | slowest decay without error | with "
      "\\|\\|E\\|\\| = 0.2 | with 0.5 |\n|---|---|---|---|---|\n");
  for (const double damping : {0.3, 0.5, 0.7, 1.0, 1.5, 2.0}) {
    const runtime::Gains gains = runtime::acceleration_gains(6, kBandwidth, damping);
    std::printf("| %.1f | %.3f | %.2f /s | %.2f /s | %.2f /s |\n", damping,
                runtime::largest_survived_error(gains).norm, runtime::guaranteed_decay(gains, 0),
                runtime::guaranteed_decay(gains, 0.2), runtime::guaranteed_decay(gains, 0.5));
  }
  std::printf(
      "\n| model error, UR10e | median \\|\\|E\\|\\| | largest of 200 | slowest eigenvalue of 200 "
      "|\n|---|---|---|---|\n");
  const NumericRobot truth = numeric_robot(read_model("tests/studies/robots/ur10e.robot"));
  const VectorXd q = study_robot("ur10e").limits.centre;
  const MatrixXd M = mass_matrix_of(numeric_plant(truth), q);
  const runtime::Gains gains = runtime::acceleration_gains(6, kBandwidth, 1);
  for (const double size : {0.05, 0.1, 0.2, 0.5}) {
    std::mt19937_64 random(kSeed);
    std::vector<double> norms;
    double slowest = -1e9;
    for (int k = 0; k < 200; ++k) {
      const MatrixXd E = runtime::inertia_error(
          M, mass_matrix_of(numeric_plant(wrong_model(truth, size, random)), q));
      norms.push_back(E.operatorNorm());
      slowest = std::max(slowest, runtime::error_eigenvalues(gains, E).real().maxCoeff());
    }
    std::sort(norms.begin(), norms.end());
    std::printf("| %.0f %% | %.2f | %.2f | %.2f /s |\n", 100 * size, norms[100], norms.back(),
                slowest);
  }
}

/// For a picture, as CSV: the margin of the inclusion regions over the complex plane, and
/// eigenvalues of random errors within the same bounds. UR10e, damping 0.7, links wrong by 20 %.
void regions() {
  const NumericRobot truth = numeric_robot(read_model("tests/studies/robots/ur10e.robot"));
  const VectorXd q = study_robot("ur10e").limits.centre;
  const MatrixXd M = mass_matrix_of(numeric_plant(truth), q);
  const runtime::Gains gains = runtime::acceleration_gains(6, kBandwidth, 0.7);
  std::mt19937_64 random(kSeed);
  MatrixXd bound = MatrixXd::Zero(6, 6);
  std::vector<MatrixXd> errors_of_models;
  for (int k = 0; k < 200; ++k) {
    const NumericRobot model = wrong_model(truth, 0.2, random);
    errors_of_models.push_back(runtime::inertia_error(M, mass_matrix_of(numeric_plant(model), q)));
    bound = bound.cwiseMax(errors_of_models.back().cwiseAbs());
  }
  std::printf("kind,re,im,margin\n");
  for (const MatrixXd& E : errors_of_models) {
    for (const std::complex<double>& s : runtime::error_eigenvalues(gains, E)) {
      std::printf("eigenvalue,%.6g,%.6g,%.6g\n", s.real(), s.imag(),
                  runtime::inclusion_margin(gains, bound, s));
    }
  }
  for (double re = -40; re <= 10; re += 0.5) {
    for (double im = -40; im <= 40; im += 0.5) {
      std::printf("grid,%.6g,%.6g,%.6g\n", re, im,
                  runtime::inclusion_margin(gains, bound, {re, im}));
    }
  }
}

int run(const std::string& table) {
  if (table == "regions") {
    regions();
    return 0;
  }
  const bool all = table == "all";
  if (!all && table != "rates" && table != "errors" && table != "geared" && table != "stability") {
    std::fprintf(
        stderr,
        "control_study: found '%s', expected rates, errors, geared, stability, all or regions\n",
        table.c_str());
    return 2;
  }
  if (all || table == "rates") rates();
  if (all || table == "errors") errors();
  if (all || table == "geared") geared();
  if (all || table == "stability") stability();
  return 0;
}

}  // namespace
}  // namespace dyngen::test

int main(int argc, char** argv) { return dyngen::test::run(argc > 1 ? argv[1] : "all"); }
