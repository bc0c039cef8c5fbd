// SPDX-License-Identifier: MIT
#include "tests/blind/cases/record.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// the first parts of the noise's numbers that are theirs
constexpr std::uint64_t kOfEncoders = 1000, kOfDisturbances = 2000;
constexpr double kMostLead = 7;   // s
constexpr double kSwitch = 0.05;  // rad/s, over which a drive's compensation of friction turns

using Wandering = std::vector<std::function<double(double)>>;  // of each joint

/// What disturbs the loop in one recording; empty: nothing.
Wandering disturbance_of(const Draft& draft, double lead, double duration, Random random) {
  Wandering all;
  for (Index j = 0; j < draft.disturbance.size(); ++j) {
    all.push_back([size = draft.disturbance[j],
                   unit = wandering(draft.memory, -lead, duration,
                                    random.part(static_cast<std::uint64_t>(j)))](double t) {
      return size * unit(t);
    });
  }
  return all;
}

Wandering disturbance_of(const Draft& draft, const Ride& ride) {
  return disturbance_of(draft, ride.lead, ride.duration,
                        Random(draft.noise_seed).part(kOfDisturbances + ride.place));
}

/// Friction that the drive adds to the torque it writes down, by the wanted velocity; (j) or empty.
VectorXd compensation_of(const Draft& draft, const Ride& ride, double t) {
  VectorXd torque = draft.compensation;
  if (torque.size() == 0) return torque;
  const VectorXd dq = ride.motion.at(t).dq;
  for (Index j = 0; j < torque.size(); ++j) {
    torque[j] *=
        draft.machine.coulomb[j] * std::tanh(dq[j] / kSwitch) + draft.machine.viscous[j] * dq[j];
  }
  return torque;
}

/// What acts beside the recorded torque.
void add_beside(const Draft& draft, const Ride& ride, Plant& plant) {
  const Wandering disturbance = disturbance_of(draft, ride);
  if (!disturbance.empty()) {
    plant.forces.push_back([disturbance, drive = plant.drive](const Moment& m, VectorXd& force) {
      for (std::size_t j = 0; j < drive.size(); ++j) force[drive[j]] += disturbance[j](m.t);
    });
  }
  if (draft.compensation.size() == 0) return;
  plant.acting = [&draft, ride, old = plant.acting](const Moment& m) -> VectorXd {
    return (old ? old(m) : m.command) + compensation_of(draft, ride, m.t);
  };
}

void record_beside(const Draft& draft, const Ride& ride, Recording& recording) {
  const Wandering disturbance = disturbance_of(draft, ride);
  const Index samples = recording.log.q.rows(), joints = recording.log.q.cols();
  if (!disturbance.empty()) recording.disturbance.resize(samples, joints);
  if (draft.compensation.size() > 0) recording.compensation.resize(samples, joints);
  for (Index k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) / draft.rate;
    for (std::size_t j = 0; j < disturbance.size(); ++j) {
      recording.disturbance(k, static_cast<Index>(j)) = disturbance[j](t);
    }
    if (draft.compensation.size() > 0) {
      recording.compensation.row(k) = compensation_of(draft, ride, t).transpose();
    }
  }
}

/// The plant of one recording, with some truths at their sizes.
Plant plant_of(const Draft& draft, const std::vector<Truth>& truths,
               const std::vector<double>& sizes, const Ride& ride) {
  const int place = static_cast<int>(ride.place);
  Tree tree = draft.machine.tree;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (truths[i].tree) truths[i].tree(sizes[i], tree);
  }
  Plant plant = assemble(draft.machine, tree, draft.engine);
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (truths[i].plant) truths[i].plant(sizes[i], place, plant);
  }
  const Engine believed = draft.engine(draft.believed.tree);
  close_loop(plant, draft.loop, believed, draft.believed.armature,
             middle_inertia(draft.believed, believed), draft.believed.coulomb, ride.motion);
  add_beside(draft, ride, plant);
  return plant;
}

constexpr std::uint64_t kOfDraws = 1000000;  // the first part of other draws
constexpr double kReadingNoise = 0.5;        // of an encoder's last digit

/// What encoders show less where the motors are.
VectorXd reading_error(const VectorXd& q, double digit, Random& random) {
  VectorXd shown = q;
  for (double& x : shown) x = std::round(x / digit + kReadingNoise * random.normal()) * digit;
  return shown - q;
}

/// What the encoders show less where the motors are: their last digit, and noise of half of it, so
/// that no two periods are read alike. The controller takes it in
/// through a low-pass of 12 Hz, and between samples in a line from the value before to this one:
/// torque that jumped at the samples would be recorded half a sample early, and faster torque would
/// act between samples otherwise than a record shows. Either looks like physics.
class Encoders {
 public:
  Encoders(double digit, double rate, Index joints, Random random)
      : digit_(digit),
        rate_(rate),
        random_(random),
        pass_(1 - std::exp(-2 * std::numbers::pi * kPass / rate)),
        once_(VectorXd::Zero(joints)),
        twice_(once_),
        slope_(once_) {}
  void operator()(const VectorXd& q, Moment& moment) {
    const VectorXd before = twice_, slope_before = slope_;
    once_ += pass_ * (error(q, moment.t) - once_);
    twice_ += pass_ * (once_ - twice_);
    slope_ = (twice_ - before) * rate_;
    moment.q_error = before;
    moment.q_error_rate = slope_;
    moment.dq_error = slope_before;
    moment.dq_error_rate = (slope_ - slope_before) * rate_;
    moment.t_error = moment.t;
  }
  /// The same whenever it is asked for.
  VectorXd error(const VectorXd& q, double t) const {
    Random random =
        Random(random_).part(static_cast<std::uint64_t>(std::llround(t * rate_) + kEarlier));
    return reading_error(q, digit_, random);
  }

 private:
  static constexpr double kPass = 12;               // Hz
  static constexpr long long kEarlier = 1LL << 40;  // samples: no place is negative
  double digit_, rate_;
  Random random_;
  double pass_;
  VectorXd once_, twice_, slope_;
};

Eigen::MatrixXd noise_of(const Draft& draft, const VectorXd& deviation, Index samples,
                         Random random) {
  Noise noise = draft.noise;
  noise.deviation = deviation;
  return torque_noise(noise, samples, random);
}

}  // namespace

Ride ride_of(const Draft& draft, std::size_t place) {
  Ride ride{draft.motions[place], 1, 0, place};
  const double once = ride.motion.duration;
  ride.lead = ride.motion.repeats ? std::min(once, kMostLead) : 1;
  ride.duration = ride.motion.repeats ? (place < draft.training ? draft.periods : 2) * once : once;
  return ride;
}

Recording record(const Draft& draft, const std::vector<Truth>& truths,
                 const std::vector<double>& sizes, const Ride& ride) {
  Plant plant = plant_of(draft, truths, sizes, ride);
  RunOptions options;
  options.rate = draft.rate;
  options.lead = ride.lead;
  options.duration = ride.duration;
  const Wanted first = ride.motion.at(-options.lead);
  VectorXd x = VectorXd::Zero(plant.coordinates()), v = x;
  for (Index j = 0; j < plant.joints(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    for (const Index c : {plant.carried[i], plant.drive[i]}) {
      x[c] = first.q[j];
      v[c] = first.dq[j];
    }
  }
  Encoders encoders(draft.noise.digit(), draft.rate, plant.joints(),
                    Random(draft.noise_seed).part(kOfEncoders + ride.place));
  Recording recording;
  recording.place = ride.place;
  recording.log =
      blind::run(plant, x, v, options, [&](const VectorXd& q, Moment& m) { encoders(q, m); });
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (truths[i].log) truths[i].log(sizes[i], static_cast<int>(ride.place), recording.log);
  }
  record_beside(draft, ride, recording);
  const MatrixXd& q = recording.log.q;
  recording.encoder_error.resize(q.rows(), q.cols());
  for (Index k = 0; k < q.rows(); ++k) {
    recording.encoder_error.row(k) =
        encoders.error(q.row(k), static_cast<double>(k) / draft.rate).transpose();
  }
  return recording;
}

VectorXd noise_deviation(const Draft& draft) {
  const Recording plain = record(draft, {}, {}, ride_of(draft, 0));
  VectorXd deviation = draft.noise.deviation;
  for (Index j = 0; j < deviation.size(); ++j) {
    const VectorXd tau = plain.log.recorded.col(j);
    deviation[j] *= std::sqrt((tau.array() - tau.mean()).square().mean());
  }
  return deviation;
}

void add_noise(const Draft& draft, const VectorXd& deviation, std::vector<Recording>& all) {
  Random random(draft.noise_seed);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].torque_noise = noise_of(draft, deviation, all[i].log.q.rows(), random.part(i));
  }
}

void add_noise_at(const Draft& draft, const VectorXd& deviation, std::size_t place,
                  Recording& recording) {
  Random random(draft.noise_seed);
  for (std::size_t i = 0; i < place; ++i) random.part(i);  // a part moves the generator on
  recording.torque_noise = noise_of(draft, deviation, recording.log.q.rows(), random.part(place));
}

DrawNoise noise_draws(const Draft& draft, const VectorXd& deviation) {
  return [&draft, deviation](std::size_t place, std::size_t draw, Recording& recording) {
    Random random = Random(draft.noise_seed).part(kOfDraws + place);
    random = random.part(draw);
    const MatrixXd& q = recording.log.q;
    recording.torque_noise = noise_of(draft, deviation, q.rows(), random.part(0));
    const double digit = draft.noise.digit();
    for (Index k = 0; k < q.rows(); ++k) {
      recording.encoder_error.row(k) = reading_error(q.row(k), digit, random).transpose();
    }
    // in the equations of the recorded torque, the disturbance of the loop is noise
    const double duration = static_cast<double>(q.rows()) / draft.rate;
    const Wandering other = disturbance_of(draft, 0, duration, random);
    for (Index j = 0; j < q.cols() && !other.empty(); ++j) {
      for (Index k = 0; k < q.rows(); ++k) {
        recording.torque_noise(k, j) +=
            other[static_cast<std::size_t>(j)](static_cast<double>(k) / draft.rate);
      }
    }
  };
}

Whitener whitener_of(const Draft& draft, const VectorXd& deviation) {
  std::vector<Recording> training;
  for (std::size_t place = 0; place < draft.training; ++place) {
    training.push_back(record(draft, {}, {}, ride_of(draft, place)));
  }
  return Whitener(training, noise_draws(draft, deviation));
}

}  // namespace blind
