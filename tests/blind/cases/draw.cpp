// SPDX-License-Identifier: MIT
#include "tests/blind/cases/draw.h"

#include <array>
#include <cmath>

namespace blind {
namespace {

using Eigen::Index;

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

/// A kind of physics, evenly among the families, and a joint where it is possible.
std::optional<Choice> choose(const std::vector<Physics>& all, const Machine& machine,
                             const std::string& family, Random& random) {
  std::vector<const Physics*> candidates;
  for (const Physics& physics : all) {
    if (family.empty() || physics.family == family) candidates.push_back(&physics);
  }
  if (candidates.empty()) return {};
  const Physics* const physics = candidates[random.below(candidates.size())];
  std::vector<Index> joints;
  for (Index j = 0; j < machine.joints(); ++j) {
    if (!physics->possible || physics->possible(machine, j)) joints.push_back(j);
  }
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

}  // namespace

std::optional<Draft> draw_case(const CaseOptions& options, const std::string& arms) {
  Random random(options.seed);
  Draft draft;
  const std::string drawn = kArms[random.below(kArms.size())];
  draft.arm = read_arm(arms + "/" + (options.arm.empty() ? drawn : options.arm) + ".xml");
  draft.machine = draw_machine(draft.arm, random.part(1));
  draft.believed = mistaken(draft.machine, random.part(2));
  draft.engine = random.chance(0.5) ? mujoco_engine : dart_engine;
  constexpr std::array<Loop, 3> kLoops = {Loop::kPd, Loop::kPid, Loop::kComputedTorque};
  draft.loop = {kLoops[random.below(kLoops.size())], random.between(30, 80)};
  draft.noise = draw_noise(options.noisy, draft.arm.joints(), random);
  draft.noise.colour = options.colour.value_or(draft.noise.colour);
  constexpr std::array<double, 3> kRates = {200, 250, 400};
  draft.rate = kRates[random.below(kRates.size())];
  const double period = 0.2 * std::round(random.between(18, 26));
  Random paths = random.part(3);
  for (std::size_t i = 0; i < draft.training; ++i) {
    draft.motions.push_back(fourier_motion(draft.arm, period, paths.part(i)));
  }
  draft.motions.push_back(fourier_motion(draft.arm, 1.3 * period, paths.part(10)));
  draft.motions.push_back(point_to_point(draft.arm, 10, paths.part(11)));
  draft.noise_seed = random.below(1U << 30);
  const Schedule schedule{draft.periods * period, static_cast<int>(draft.training)};
  const std::vector<Physics> all = physics_of(options.kind, schedule);
  const std::size_t count = options.kind == "null" ? 0 : options.kind == "pair" ? 2 : 1;
  Random truths = random.part(4);
  while (draft.truths.size() < count) {
    const auto choice = choose(all, draft.machine, options.family, truths);
    if (!choice) return {};
    const bool again =
        !draft.truths.empty() && (draft.truths.front().family == choice->physics->family ||
                                  draft.truths.front().joint == choice->joint + 1);
    if (again) continue;
    draft.truths.push_back(
        choice->physics->draw(draft.machine, choice->joint, truths.part(draft.truths.size())));
  }
  return draft;
}

}  // namespace blind
