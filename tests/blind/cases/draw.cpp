// SPDX-License-Identifier: MIT
#include "tests/blind/cases/draw.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/blind/cases/crowd.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kWeakest = 100, kStrongest = 5000;  // wanted of effects of a crowd

/// Small arms stand more often than large ones: their cases cost less.
constexpr std::array<const char*, 10> kArms = {"planar2",  "planar2",  "planar2", "twisted4",
                                               "twisted4", "twisted4", "puma560", "puma560",
                                               "ur10e",    "panda"};

std::vector<Physics> physics_of(const std::string& kind, const Schedule& schedule) {
  if (kind == "hidden") return hidden_physics();
  if (kind == "foreign") return foreign_physics(schedule);
  if (kind == "passing") return passing_physics(schedule);
  std::vector<Physics> all;
  for (const auto& room : {friction_physics, drive_physics, sensor_physics, structure_physics}) {
    const std::vector<Physics> some = room(schedule);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

struct Choice {
  const Physics* physics = nullptr;
  Index joint = 0;
};

/// A kind of physics, evenly among the families, and a joint where it is possible, or the wanted
/// one.
std::optional<Choice> choose(const std::vector<Physics>& all, const Machine& machine,
                             const CaseOptions& options, Random& random) {
  std::vector<const Physics*> candidates;
  for (const Physics& physics : all) {
    if (options.family.empty() || physics.family == options.family) candidates.push_back(&physics);
  }
  if (candidates.empty()) return {};
  const Physics* const physics = candidates[random.below(candidates.size())];
  std::vector<Index> joints;
  for (Index j = 0; j < machine.joints(); ++j) {
    if (!physics->possible || physics->possible(machine, j)) joints.push_back(j);
  }
  if (options.joint > machine.joints()) return {};
  if (options.joint > 0) joints = {options.joint - 1};
  if (joints.empty()) return {};
  return Choice{physics, joints[random.below(joints.size())]};
}

Noise draw_noise(bool noisy, Index joints, Random& random) {
  Noise noise;
  constexpr std::array<Colour, 4> kColours = {Colour::kWhite, Colour::kAutoregressive,
                                              Colour::kMixed, Colour::kPink};
  noise.colour = kColours[random.below(kColours.size())];
  noise.memory = random.chance(0.25) ? 0.95 : random.between(0.3, 0.9);
  noise.deviation = Eigen::VectorXd::Constant(joints, random.between(0.01, 0.03));
  noise.bits = 16 + static_cast<int>(random.below(5));
  if (!noisy) {
    noise.deviation.setZero();
    noise.bits = 40;
  }
  return noise;
}

/// A stream of its own for what a habit draws: a seed has the same machine in all habits.
Random habit_random(std::uint64_t seed) { return Random(seed ^ 0x4AB17ULL); }

std::string arm_of(const CaseOptions& options, const std::string& drawn) {
  if (options.arm.empty()) return drawn;
  if (options.arm != "small") return options.arm;
  return habit_random(options.seed).part(1).chance(0.5) ? "planar2" : "twisted4";
}

/// Root mean square torque of the machine along a motion, about, (j) N m.
VectorXd torque_along(const Machine& machine, const Motion& motion) {
  const Engine engine = mujoco_engine(machine.tree);
  VectorXd square = VectorXd::Zero(machine.joints());
  constexpr int kLooks = 200;
  for (int i = 0; i < kLooks; ++i) {
    const Wanted here = motion.at(motion.duration * i / kLooks);
    const VectorXd torque =
        engine.inverse(here.q, here.dq, here.ddq) + machine.armature.cwiseProduct(here.ddq) +
        machine.viscous.cwiseProduct(here.dq) + machine.coulomb.cwiseProduct(here.dq.cwiseSign());
    square += torque.cwiseAbs2() / kLooks;
  }
  return square.cwiseSqrt();
}

/// Motions of the habit. @param period  s, of the laboratory's motion
void draw_motions(const Habit& habit, double period, Random paths, Random& own, Draft& draft) {
  draft.training = static_cast<std::size_t>(habit.files);
  draft.periods = habit.periods;
  double length = 5 * period;
  if (!habit.length.empty()) length = own.decade(habit.length.low, habit.length.high);
  if (habit.path == Path::kFourier) length /= habit.periods;
  length = 0.2 * std::max(1.0, std::round(5 * length));  // whole samples at all rates
  // a long period is slow, or has as many waves as several short ones
  constexpr int kHarmonics = 5;
  const bool rich = own.chance(0.5);
  const int harmonics = rich && habit.periods < 5 ? 5 * kHarmonics / habit.periods : kHarmonics;
  for (std::size_t i = 0; i < draft.training; ++i) {
    draft.motions.push_back(
        motion_along({habit.path, length, habit.periods, harmonics}, draft.arm, paths.part(i)));
  }
  for (std::size_t i = 0; i < habit.heldout.size(); ++i) {
    const double held = habit.heldout[i] == Path::kFourier ? 1.3 * period : 10;
    draft.motions.push_back(
        motion_along({habit.heldout[i], held, 1, kHarmonics}, draft.arm, paths.part(10 + i)));
  }
}

/// Instruments of the habit, and what its drives do.
void draw_instruments(const Habit& habit, bool noisy, Random& own, Draft& draft) {
  const Index n = draft.arm.joints();
  const auto of = [&](const Range& range) { return own.between(range.low, range.high); };
  if (!habit.rates.empty()) draft.rate = habit.rates[own.below(habit.rates.size())];
  if (habit.bits && noisy) draft.noise.bits = static_cast<int>(std::lround(of(*habit.bits)));
  draft.noise.colour = habit.colour.value_or(draft.noise.colour);
  draft.logger.jitter = of(habit.jitter);
  draft.logger.digit = habit.stamp_digit;
  draft.logger.late = std::lround(of(habit.late));
  draft.logger.stamps = own.below(1U << 30);
  if (habit.gain_error > 0) {
    draft.logger.gain.resize(n);
    for (double& gain : draft.logger.gain) gain = 1 + habit.gain_error * own.normal();
  }
  if (!habit.disturbance.empty()) {
    draft.disturbance_share = own.decade(habit.disturbance.low, habit.disturbance.high);
    draft.memory = own.decade(habit.memory.low, habit.memory.high);
    draft.disturbance =
        draft.disturbance_share * torque_along(draft.machine, draft.motions.front());
  }
  if (!habit.compensation_error.empty()) {
    draft.compensation.resize(n);
    for (double& share : draft.compensation) share = 1 + own.sign() * of(habit.compensation_error);
  }
}

}  // namespace

std::optional<Draft> draw_case(const CaseOptions& options, const std::string& arms) {
  Random random(options.seed);
  Draft draft;
  const std::string drawn = kArms[random.below(kArms.size())];
  draft.arm = read_arm(arms + "/" + arm_of(options, drawn) + ".xml");
  draft.machine = draw_machine(draft.arm, random.part(1));
  draft.believed = mistaken(draft.machine, random.part(2));
  draft.engine = random.chance(0.5) ? mujoco_engine : dart_engine;
  constexpr std::array<Loop, 3> kLoops = {Loop::kPd, Loop::kPid, Loop::kComputedTorque};
  draft.loop = {kLoops[random.below(kLoops.size())], random.between(30, 80)};
  draft.noise = draw_noise(options.noisy, draft.arm.joints(), random);
  constexpr std::array<double, 3> kRates = {200, 250, 400};
  draft.rate = kRates[random.below(kRates.size())];
  const double period = 0.2 * std::round(random.between(18, 26));
  const Habit& habit = habit_of(options.habit);
  Random own = habit_random(options.seed);
  draw_motions(habit, period, random.part(3), own, draft);
  draw_instruments(habit, options.noisy, own, draft);
  draft.noise.colour = options.colour.value_or(draft.noise.colour);
  draft.noise_seed = random.below(1U << 30);
  const double once = draft.motions.front().duration;
  const double length = draft.motions.front().repeats ? draft.periods * once : once;
  const Schedule schedule{length, static_cast<int>(draft.training)};
  const std::vector<Physics> all = physics_of(options.kind, schedule);
  if (options.kind == "crowd") {
    draft.truths = draw_crowd(draft.machine, schedule, random.part(4));
    for (std::size_t i = 0; i < draft.truths.size(); ++i) {
      draft.wanted.push_back(own.decade(kWeakest, kStrongest));
    }
    return draft;
  }
  const std::size_t count = options.kind == "null" ? 0 : options.kind == "pair" ? 2 : 1;
  Random truths = random.part(4);
  while (draft.truths.size() < count) {
    const auto choice = choose(all, draft.machine, options, truths);
    if (!choice) return {};
    const bool again =
        !draft.truths.empty() && (draft.truths.front().family == choice->physics->family ||
                                  draft.truths.front().joint == choice->joint + 1);
    if (again) continue;
    draft.truths.push_back(
        choice->physics->draw(draft.machine, choice->joint, truths.part(draft.truths.size())));
  }
  draft.wanted.assign(count, options.lambda);
  return draft;
}

}  // namespace blind
