// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/effects/effect_rows.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "tests/studies/strength_meter.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectLaw;
using runtime::EffectRecordings;
using runtime::EffectRole;
using runtime::Recording;

constexpr double kMostScaled = 25;  // times the typical size: beyond, no machine is like that
constexpr double kSeen = 1e-5;      // part of the squares that a refit must leave
constexpr double kHardly = 1e-3;    // part of a theorem that measurement and friction at rest leave

bool time_local(const EffectLaw& law) {
  return law.family == "payload_change" || law.family == "contact";
}

bool reads(const EffectLaw& law, const char* variable) {
  return std::find(law.variables.begin(), law.variables.end(), variable) != law.variables.end();
}

/// Links as the robot file counts them: the study's robots have one coordinate a link.
void set_link(EffectInstance& effect) { effect.link = effect.joint + 1; }

/// Numbers of an effect of about its typical size.
VectorXd drawn_size(const EffectLaw& law, const runtime::EffectSizes& sizes, double duration,
                    std::mt19937_64& random) {
  std::uniform_real_distribution<double> spread(0.7, 1.3), unit(0, 1);
  VectorXd drawn = sizes.typical;
  for (Index p = 0; p < drawn.size(); ++p) {
    const auto& parameter = law.parameters[static_cast<std::size_t>(p)];
    if (parameter.role == EffectRole::kGiven) continue;
    if (parameter.name == "ratio") {
      drawn[p] = unit(random) < 0.5 ? -1 : 1;
    } else if (parameter.name == "t_on") {
      drawn[p] = duration * (0.3 + 0.4 * unit(random));
    } else if (parameter.name == "t_off") {
      drawn[p] = drawn[p - 1] + 0.3 + 1.2 * unit(random);
    } else {
      drawn[p] *= spread(random);
      const bool either = parameter.role == EffectRole::kLinear && sizes.min[p] < 0;
      if (either && unit(random) < 0.5) drawn[p] = -drawn[p];
      drawn[p] = std::clamp(drawn[p], sizes.min[p], sizes.max[p]);
    }
  }
  return drawn;
}

bool is_linear(const EffectLaw& law, Index p) {
  return law.parameters[static_cast<std::size_t>(p)].role == EffectRole::kLinear;
}

double squares(const std::vector<MatrixXd>& torque) {
  double sum = 0;
  for (const MatrixXd& part : torque) sum += part.squaredNorm();
  return sum;
}

/// The numbers nearest to an effect's at which it is not there, its shapes kept: linear parameters
/// 0, or what makes them vanish; of effects that have none, the end of the range where they do.
std::optional<VectorXd> where_it_vanishes(const Bench& bench, EffectInstance effect,
                                          const runtime::EffectSizes& sizes) {
  const VectorXd drawn = effect.parameters;
  const auto torque_at = [&](const VectorXd& parameters) {
    effect.parameters = parameters;
    return torque_in(bench, effect, -1);
  };
  const double full = squares(torque_at(drawn));
  if (!(full > 0) || !std::isfinite(full)) return std::nullopt;
  VectorXd without = drawn;
  std::vector<Index> linear;
  for (Index p = 0; p < drawn.size(); ++p) {
    if (is_linear(effect.law, p)) linear.push_back(p);
  }
  std::vector<VectorXd> ends;
  if (linear.empty()) {
    for (const VectorXd* end : {&sizes.min, &sizes.max}) {
      for (Index p = 0; p < drawn.size(); ++p) {
        const EffectRole role = effect.law.parameters[static_cast<std::size_t>(p)].role;
        if (role != EffectRole::kGiven) without[p] = (*end)[p];
      }
      ends.push_back(without);
    }
  } else {
    for (const Index p : linear) without[p] = 0;
    ends.push_back(without);
    if (linear.size() == 1 && drawn[linear[0]] != 0) {  // T = T0 + p T1
      const std::vector<MatrixXd> T0 = torque_at(without), T = torque_at(drawn);
      double along = 0, length = 0;
      for (std::size_t r = 0; r < T.size(); ++r) {
        const MatrixXd T1 = (T[r] - T0[r]) / drawn[linear[0]];
        along -= (T1.array() * T0[r].array()).sum();
        length += T1.squaredNorm();
      }
      without[linear[0]] = along / length;
      ends.push_back(without);
    }
  }
  for (const VectorXd& end : ends) {
    if (end.allFinite() && squares(torque_at(end)) < 1e-16 * full) return end;
  }
  return std::nullopt;
}

/// Whether a machine could have it, and usually has: its file's bounds and conditions.
bool could_be(const EffectInstance& effect, const runtime::EffectSizes& sizes,
              const runtime::EffectScales& scales) {
  const VectorXd& p = effect.parameters;
  bool could = (p.array() >= sizes.min.array()).all() && (p.array() <= sizes.max.array()).all();
  for (const auto* conditions :
       {&effect.law.requirements, &effect.law.falsifiers, &effect.law.usual}) {
    for (const runtime::EffectCondition& condition : *conditions) {
      could = could && condition.slack(p, scales) >= 0;
    }
  }
  return could;
}

/// Gives an effect a strength; none if it cannot have it.
std::optional<TrueEffect> scaled(const Bench& bench, const StrengthMeter& meter,
                                 const EffectInstance& drawn, const runtime::EffectScales& scales,
                                 double lambda, int only) {
  const runtime::EffectSizes sizes = drawn.law.sizes(scales);
  const std::optional<VectorXd> nothing = where_it_vanishes(bench, drawn, sizes);
  if (!nothing) return std::nullopt;
  TrueEffect result{drawn, 0, 0, only, {}};
  double scale = 1;
  for (int round = 0; round < 6; ++round) {
    result.effect.parameters = *nothing + scale * (drawn.parameters - *nothing);
    const auto torque = torque_in(bench, result.effect, only);
    const double before = meter.whitened(torque).squaredNorm();
    result.lambda = meter.left_of(torque).squaredNorm();
    result.absorbed = before > 0 ? 1 - result.lambda / before : 1;
    if (!std::isfinite(before) || result.absorbed > 1 - kSeen) return std::nullopt;
    if (std::abs(result.lambda / lambda - 1) < 0.01) {
      return could_be(result.effect, sizes, scales) ? std::optional(result) : std::nullopt;
    }
    scale *= std::sqrt(lambda / result.lambda);
    if (!(scale < kMostScaled)) return std::nullopt;
  }
  return std::nullopt;
}

/// Families of which cases of single effects are drawn, in the catalogue's order.
std::vector<std::string> drawn_families(bool of_part) {
  std::vector<std::string> families;
  for (const EffectLaw& law : all_laws()) {
    const auto& theorems = theorem_laws();
    if (std::find(theorems.begin(), theorems.end(), law.name) != theorems.end()) continue;
    if (law.name == "payload" || law.name == "rotor_inertia") continue;
    if (time_local(law) != of_part) continue;
    if (std::find(families.begin(), families.end(), law.family) == families.end()) {
      families.push_back(law.family);
    }
  }
  return families;
}

template <class T>
const T& one_of(const std::vector<T>& values, std::mt19937_64& random) {
  return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

EffectInstance placed(const CaseRobot& robot, const EffectLaw& law, std::mt19937_64& random) {
  std::vector<EffectInstance> places = runtime::atlas_effects(robot.told.linear, {law});
  EffectInstance effect = one_of(places, random);
  set_link(effect);
  return effect;
}

/// @param left    what a refit of the model leaves of a torque, whitened
/// @param joints  on which it acts
/// @param family  that is not looked at
Nearest nearest_effect(StrengthMeter& meter, const Bench& bench, const VectorXd& left,
                       const std::vector<int>& joints, const std::string& family,
                       const runtime::EffectScales& scales) {
  Nearest nearest;
  for (const EffectInstance& other : all_hypotheses(bench.robot, scales)) {
    if (other.law.family == family) continue;
    const std::vector<int> theirs = runtime::joints_of(other, bench.robot.joints());
    const bool meet = std::any_of(joints.begin(), joints.end(), [&](int j) {
      return std::find(theirs.begin(), theirs.end(), j) != theirs.end();
    });
    if (!meet) continue;
    const double likeness = meter.likeness(left, other);
    if (likeness > nearest.likeness) nearest = {likeness, other.law.family};
  }
  return nearest;
}

/// One effect of the wanted family, or of any, with its strength.
std::optional<TrueEffect> drawn_effect(const Bench& bench, const std::string& family,
                                       const TruthRequest& request,
                                       const runtime::AtlasNoise& noise, std::mt19937_64& random) {
  std::vector<EffectLaw> members;
  for (const EffectLaw& law : all_laws()) {
    if (law.family != family || law.name == "rotor_inertia") continue;
    const auto& theorems = theorem_laws();
    if (std::find(theorems.begin(), theorems.end(), law.name) != theorems.end()) continue;
    if (reads(law, "temp") && !bench.settings.temperature) continue;
    members.push_back(law);
  }
  if (members.empty()) return std::nullopt;
  EffectInstance effect = placed(bench.robot, one_of(members, random), random);
  const EffectRecordings data = plain_recordings(bench, &effect.law, effect.joint);
  const runtime::EffectScales scales = runtime::scales_of(data, bench.robot.beta, effect.joint);
  const runtime::EffectSizes sizes = effect.law.sizes(scales);
  effect.parameters = drawn_size(effect.law, sizes, bench.settings.train_seconds(), random);
  const int only = time_local(effect.law) && random() % 2 == 0
                       ? static_cast<int>(random() % kTrainRecordings)
                       : -1;
  StrengthMeter meter(data, bench.robot.beta, noise);
  std::optional<TrueEffect> truth = scaled(bench, meter, effect, scales, request.lambda, only);
  if (truth && request.with_likeness) {
    truth->nearest = nearest_effect(
        meter, bench, meter.left_of(torque_in(bench, truth->effect, truth->recording)),
        runtime::joints_of(truth->effect, bench.robot.joints()), family, scales);
  }
  return truth;
}

}  // namespace

const std::vector<EffectLaw>& all_laws() {
  static const std::vector<EffectLaw> laws = runtime::effect_laws(EffectCatalogue{});
  return laws;
}

const std::vector<std::string>& theorem_laws() {
  static const std::vector<std::string> names = {"constant_offset", "coulomb_asymmetry",
                                                 "sine_counterbalance", "payload",
                                                 "global_torque_gain"};
  return names;
}

std::vector<EffectInstance> all_hypotheses(const CaseRobot& robot,
                                           const runtime::EffectScales& scales) {
  std::vector<EffectInstance> effects = runtime::atlas_effects(robot.told.linear, all_laws());
  for (EffectInstance& effect : effects) {
    set_link(effect);
    effect.parameters.setConstant(effect.law.size(), std::numeric_limits<double>::quiet_NaN());
    const VectorXd typical = effect.law.sizes(scales).typical;
    for (Index p = 0; p < typical.size(); ++p) {
      const EffectRole role = effect.law.parameters[static_cast<std::size_t>(p)].role;
      if (role == EffectRole::kGiven) effect.parameters[p] = typical[p];
    }
  }
  return effects;
}

std::vector<TrueEffect> drawn_truth(const Bench& bench, const TruthRequest& request,
                                    const runtime::AtlasNoise& noise, std::mt19937_64& random) {
  const std::vector<std::string> families = drawn_families(request.time_local);
  std::vector<TrueEffect> truth;
  for (int tries = 0; truth.size() < request.effects; ++tries) {
    if (tries == 60) {
      throw std::runtime_error(
          fmt::format("seed {}: no effect reaches lambda {}", request.seed, request.lambda));
    }
    // the seed goes through the families, so that all of them get their share
    std::string family = request.effects > 1 || tries >= 6
                             ? one_of(families, random)
                             : families[request.seed % families.size()];
    if (!request.family.empty() && truth.empty()) family = request.family;
    if (!truth.empty() && truth[0].effect.law.family == family) continue;
    std::optional<TrueEffect> next = drawn_effect(bench, family, request, noise, random);
    if (next) truth.push_back(std::move(*next));
  }
  return truth;
}

TrueEffect drawn_theorem(const Bench& bench, unsigned seed, const runtime::AtlasNoise& noise,
                         std::mt19937_64& random) {
  const std::string& name = theorem_laws()[seed % theorem_laws().size()];
  const auto law = std::find_if(all_laws().begin(), all_laws().end(),
                                [&](const EffectLaw& own) { return own.name == name; });
  const EffectRecordings data = plain_recordings(bench, nullptr, -1);
  const StrengthMeter meter(data, bench.robot.beta, noise);
  for (int tries = 0; tries < 60; ++tries) {
    TrueEffect truth;
    truth.effect = placed(bench.robot, *law, random);
    truth.effect.parameters =
        drawn_size(*law, law->sizes(runtime::scales_of(data, bench.robot.beta, truth.effect.joint)),
                   bench.settings.train_seconds(), random);
    const auto torque = torque_in(bench, truth.effect, -1);
    const double left = meter.left_of(torque).squaredNorm();
    truth.absorbed = 1 - left / meter.whitened(torque).squaredNorm();
    if (truth.absorbed > 1 - kHardly) return truth;
  }
  throw std::runtime_error(
      fmt::format("seed {}: {} shows on every joint of {}", seed, name, bench.robot.name));
}

ForeignStrength scale_foreign(const Bench& bench, const runtime::AtlasNoise& noise, double lambda,
                              bool with_likeness, ForeignTorque& foreign) {
  const EffectRecordings data = plain_recordings(bench, nullptr, -1);
  StrengthMeter meter(data, bench.robot.beta, noise);
  const auto torque = [&] {
    std::vector<MatrixXd> parts;
    for (std::size_t r = 0; r < kTrainRecordings; ++r) {
      const Recording& motion = bench.plain[r].truth;
      parts.push_back(MatrixXd::Zero(motion.samples(), motion.joints()));
      parts.back().col(foreign.joint) = foreign_torque(foreign, motion);
    }
    return parts;
  };
  const double whole = meter.whitened(torque()).squaredNorm();
  const double left = meter.left_of(torque()).squaredNorm();
  if (!(left > 1e-4 * whole)) return {};
  foreign.size = std::sqrt(lambda / left);
  ForeignStrength strength{lambda, 1 - left / whole, {}};
  if (with_likeness) {
    strength.nearest = nearest_effect(meter, bench, meter.left_of(torque()), {foreign.joint}, "",
                                      runtime::scales_of(data, bench.robot.beta, foreign.joint));
  }
  return strength;
}

}  // namespace dyngen::test
