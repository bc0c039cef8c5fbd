// SPDX-License-Identifier: MIT
#include "runtime/simulation/closed_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/control/velocity_filter.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What the controller knows of the robot's state.
class Sensors {
 public:
  Sensors(const ClosedLoopOptions& options, const StartState& start)
      : step_(options.encoder_step), noise_(options.encoder_noise), random_(options.seed + kSeed) {
    q = rounded(start.q);
    dq = start.dq;
    if (options.velocity_cutoff_hz > 0) {
      filter_.emplace(VelocityFilterOptions{1 / options.rate, options.velocity_cutoff_hz}, q, dq);
    }
  }

  /// A sample time after the one before.
  void read(const Plant& plant) {
    q = rounded(plant.q().head(q.size()));
    dq = filter_ ? filter_->update(q.data()) : VectorXd(plant.dq().head(q.size()));
  }

  VectorXd q, dq;

 private:
  static constexpr std::uint64_t kSeed = 1000003;  // other numbers than the torque noise has

  VectorXd rounded(VectorXd position) {
    for (Index j = 0; j < step_.size(); ++j) {
      if (step_[j] == 0) continue;
      const double noise = noise_ > 0 ? noise_ * normal_(random_) : 0;
      position[j] = step_[j] * std::round(position[j] / step_[j] + noise);
    }
    return position;
  }

  VectorXd step_;
  double noise_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::optional<VelocityFilter> filter_;
};

/// Torque that arrives at the joints later than it was asked for.
class Drive {
 public:
  Drive(const ClosedLoopOptions& options, const VectorXd& first) {
    const double samples = options.delay * options.rate;
    const double whole = std::floor(samples + 1e-9);
    late_ = std::max(0.0, samples - whole) / options.rate;
    if (late_ < 1e-9 / options.rate) late_ = 0;
    queue_.assign(static_cast<std::size_t>(whole) + 2, first);
  }

  /// The torque of this sample.
  void ask(const VectorXd& torque) {
    std::rotate(queue_.begin(), queue_.end() - 1, queue_.end());
    queue_.front() = torque;
  }
  /// s: so long after the sample `before()` still acts, then after().
  [[nodiscard]] double late() const { return late_; }
  [[nodiscard]] const VectorXd& before() const { return queue_.back(); }
  [[nodiscard]] const VectorXd& after() const { return queue_[queue_.size() - 2]; }
  /// Right after the sample.
  [[nodiscard]] const VectorXd& now() const { return late_ > 0 ? before() : after(); }

 private:
  std::vector<VectorXd> queue_;  ///< the latest first; the last two act
  double late_ = 0;
};

/// What drives give that follow a command late, as first-order lags.
class LaggingTorque {
 public:
  /// @param lag  (n) s; empty: none
  explicit LaggingTorque(VectorXd lag) : lag_(std::move(lag)) {}

  [[nodiscard]] bool exists() const { return (lag_.array() > kLeastLag).any(); }
  /// What acts right after a command, which is held for a while.
  VectorXd at_once(const VectorXd& command) {
    if (given_.size() == 0) given_ = command;
    VectorXd result = command;
    for (Index j = 0; j < lag_.size(); ++j) {
      if (lag_[j] > kLeastLag) result[j] = given_[j];
    }
    return result;
  }
  /// From `now` on. @param given  at_once() then
  [[nodiscard]] TorqueSource following(const VectorXd& command, const VectorXd& given,
                                       double now) const {
    return
        [command, given, now, lag = lag_](double time, const double*, const double*, double* tau) {
          for (Index j = 0; j < command.size(); ++j) {
            tau[j] = command[j];
            if (given[j] != command[j]) {
              tau[j] += (given[j] - command[j]) * std::exp((now - time) / lag[j]);
            }
          }
        };
  }
  void set(const VectorXd& given) { given_ = given; }

 private:
  static constexpr double kLeastLag = 1e-6;  // s: what follows faster follows at once

  VectorXd lag_, given_;
};

/// Nothing drives what is behind the drives' coordinates.
TorqueSource held(const VectorXd& torque) {
  return [torque](double, const double*, const double*, double* tau) {
    std::copy(torque.begin(), torque.end(), tau);
  };
}

Recording empty_recording(Index samples, Index joints, const char* name) {
  Recording recording;
  recording.file_name = name;
  recording.time.resize(samples);
  for (auto* part : {&recording.q, &recording.dq, &recording.tau}) part->resize(samples, joints);
  recording.run_starts = {0};
  return recording;
}

/// Coordinates of a plant where it begins: springs carry the links, which move with the drives.
StartState whole_start(const PlantModel& model, const StartState& drives) {
  if (model.drives() == model.joints) return drives;
  StartState start{model.at_rest(drives.q, drives.dq), VectorXd::Zero(model.joints)};
  for (int j = model.drives() - 1; j >= 0; --j) {
    start.dq[j] = start.dq[model.links[static_cast<std::size_t>(j)]] = drives.dq[j];
  }
  return start;
}

/// Of each drive, the coordinate of its link.
std::vector<int> links_of(const PlantModel& model) {
  std::vector<int> links = model.links;
  for (int j = static_cast<int>(links.size()); j < model.drives(); ++j) links.push_back(j);
  return links;
}

Plant plant_at(const PlantModel& model, const ClosedLoopOptions& options, const StartState& start) {
  return {model, options.integration, start.q, start.dq};
}

class Loop {
 public:
  Loop(const PlantModel& model, Controller& controller, const Trajectory& trajectory,
       const ClosedLoopOptions& options, const StartState& start)
      : controller_(controller),
        trajectory_(trajectory),
        options_(options),
        n_(model.drives()),
        links_(links_of(model)),
        lagging_(model.lag),
        plant_(plant_at(model, options, whole_start(model, start))),
        sensors_(options, start),
        noise_(options.torque_noise, model.drives(), options.seed),
        q_ref_(n_),
        dq_ref_(n_),
        ddq_ref_(n_) {
    const double duration = options.duration > 0
                                ? options.duration
                                : trajectory.time[trajectory.samples() - 1] - trajectory.time[0];
    samples_ = 1 + static_cast<Index>(std::floor(duration * options.rate * (1 + 1e-12)));
    run_.measured = empty_recording(samples_, n_, "measured");
    run_.truth = empty_recording(samples_, n_, "truth");
    run_.links = empty_recording(samples_, n_, "links");
    for (Recording* part : {&run_.truth, &run_.links}) part->ddq.resize(samples_, n_);
    run_.reference.resize(samples_, n_);
    run_.largest_torque = VectorXd::Zero(n_);
    run_.saturated_share = VectorXd::Zero(n_);
  }

  ClosedLoopRun run(const std::function<void(double)>& progress) {
    std::optional<Drive> drive;
    const TorqueSource continuous = [this](double time, const double* q, const double* dq,
                                           double* tau) { control(time, q, dq, tau); };
    VectorXd before;  // what the drive held up to this sample
    for (Index k = 0; k < samples_; ++k) {
      if (progress && k % 256 == 0) {
        progress(static_cast<double>(k) / static_cast<double>(samples_));
      }
      const double now = time_of(k), next = time_of(k + 1);
      if (k > 0) sensors_.read(plant_);
      VectorXd asked(n_);
      control(now, sensors_.q.data(), sensors_.dq.data(), asked.data());
      if (!drive) drive.emplace(options_, asked);
      drive->ask(asked);
      if (before.size() == 0 || options_.continuous) before = drive->now();
      record(k, before, drive->now());
      if (k + 1 == samples_) break;
      if (options_.continuous) {
        plant_.advance(continuous, next);
        continue;
      }
      if (drive->late() > 0) advance(drive->before(), now + drive->late());
      advance(drive->after(), next);
      before = drive->after();
    }
    run_.saturated_share /= static_cast<double>(samples_);
    run_.stuck_share = plant_.stuck_time().head(n_) / std::max(plant_.time(), 1e-300);
    run_.counts = plant_.counts();
    return std::move(run_);
  }

 private:
  [[nodiscard]] double time_of(Index k) const { return static_cast<double>(k) / options_.rate; }

  void control(double time, const double* q, const double* dq, double* tau) {
    motion_at(trajectory_, trajectory_.time[0] + time, q_ref_.data(), dq_ref_.data(),
              ddq_ref_.data());
    controller_.step({q, dq, q_ref_.data(), dq_ref_.data(), ddq_ref_.data()}, tau);
  }

  /// Under a command that is held.
  void advance(const VectorXd& command, double until) {
    if (!lagging_.exists()) return plant_.advance(held(command), until);
    const VectorXd given = lagging_.at_once(command);
    const TorqueSource following = lagging_.following(command, given, plant_.time());
    plant_.advance(following, until);
    VectorXd reached(n_);
    following(until, nullptr, nullptr, reached.data());
    lagging_.set(reached);
  }

  void record(Index k, const VectorXd& before, const VectorXd& after) {
    const VectorXd mean = (before + after) / 2;
    const VectorXd q = plant_.q(), dq = plant_.dq();
    VectorXd acting = VectorXd::Zero(q.size());
    acting.head(n_) = lagging_.at_once(after);
    const VectorXd ddq = plant_.acceleration(acting);
    run_.measured.time[k] = run_.truth.time[k] = run_.links.time[k] =
        trajectory_.time[0] + time_of(k);
    run_.measured.q.row(k) = sensors_.q;
    run_.measured.dq.row(k) = sensors_.dq;
    run_.measured.tau.row(k) = mean + noise_.next();
    run_.truth.q.row(k) = q.head(n_);
    run_.truth.dq.row(k) = dq.head(n_);
    run_.truth.ddq.row(k) = ddq.head(n_);
    run_.links.q.row(k) = q(links_);
    run_.links.dq.row(k) = dq(links_);
    run_.links.ddq.row(k) = ddq(links_);
    run_.truth.tau.row(k) = run_.links.tau.row(k) = mean;
    run_.reference.row(k) = q_ref_;
    run_.largest_torque = run_.largest_torque.cwiseMax(after.cwiseAbs());
    const VectorXd& limit = controller_.options().torque_limit;
    for (Index j = 0; j < limit.size(); ++j) {
      run_.saturated_share[j] += static_cast<double>(std::abs(after[j]) >= limit[j]);
    }
  }

  Controller& controller_;
  const Trajectory& trajectory_;
  const ClosedLoopOptions& options_;
  Index n_;
  Index samples_ = 0;
  std::vector<int> links_;
  LaggingTorque lagging_;
  Plant plant_;
  Sensors sensors_;
  TorqueNoise noise_;
  VectorXd q_ref_, dq_ref_, ddq_ref_;
  ClosedLoopRun run_;
};

void check_joints(const char* what, Index found, Index expected) {
  if (found == expected) return;
  throw std::invalid_argument(
      fmt::format("simulate(): {} has {} joints, the plant has {}", what, found, expected));
}

}  // namespace

void ClosedLoopOptions::validate(int joints) const {
  const auto fail = [](const std::string& message) {
    throw std::invalid_argument("ClosedLoopOptions: " + message);
  };
  if (!(rate > 0) || !std::isfinite(rate)) {
    fail(fmt::format("rate is {} Hz, expected a positive number", rate));
  }
  const auto not_negative = [&](const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value)) {
      fail(fmt::format("{} is {}, expected 0 or more", name, value));
    }
  };
  not_negative("delay", delay);
  not_negative("encoder_noise", encoder_noise);
  not_negative("duration", duration);
  not_negative("velocity_cutoff_hz", velocity_cutoff_hz);
  if (encoder_step.size() != 0 && (encoder_step.size() != joints || !encoder_step.allFinite() ||
                                   (encoder_step.array() < 0).any())) {
    fail(fmt::format("encoder_step has {} values, expected {} that are not negative",
                     encoder_step.size(), joints));
  }
  const bool exact = velocity_cutoff_hz == 0 && (encoder_step.array() == 0).all();
  if (continuous && (!exact || delay > 0)) {
    fail("a continuous controller has exact sensors and no delay");
  }
  torque_noise.validate(joints);
  integration.validate();
}

ClosedLoopRun simulate(const PlantModel& plant, Controller& controller,
                       const Trajectory& trajectory, const ClosedLoopOptions& options,
                       const std::optional<StartState>& start,
                       const std::function<void(double)>& progress) {
  plant.validate();
  trajectory.validate();
  options.validate(plant.drives());
  check_joints("the controller", controller.joints(), plant.drives());
  check_joints("the trajectory", trajectory.joints(), plant.drives());
  StartState from = start.value_or(StartState{trajectory.q.row(0), trajectory.dq.row(0)});
  check_joints("the start", from.q.size(), plant.drives());
  check_joints("the start", from.dq.size(), plant.drives());
  if (options.continuous && (plant.lag.array() > 0).any()) {
    throw std::invalid_argument(
        "simulate(): a continuous controller's drives have no lag, expected a rate");
  }
  return Loop(plant, controller, trajectory, options, from).run(progress);
}

Tracking tracking_of(const ClosedLoopRun& run) {
  const Eigen::MatrixXd error = run.reference - run.truth.q;
  const double samples = static_cast<double>(std::max<Index>(error.rows(), 1));
  return {(error.colwise().squaredNorm() / samples).cwiseSqrt().transpose(),
          error.cwiseAbs().colwise().maxCoeff().transpose()};
}

}  // namespace dyngen::runtime
