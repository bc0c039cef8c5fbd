// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/effect_conditions.h"

#include <algorithm>

#include "runtime/diagnosis/scans/time_windows.h"

namespace dyngen::runtime {
namespace {

constexpr double kLeastExplained = 0.7;   // of the net of a ruled-out form, by an effect beside it
constexpr double kOutdone = 9;            // squares, net, by which what has no name is better
constexpr double kOutdonePart = 0.1;      // and of the effect's
constexpr double kEventNet = 10;          // squares, net, of an event
constexpr double kShortestCondition = 3;  // equations that an event lasts

}  // namespace

bool EffectConditions::is_no_event(const EvidenceSystem& system, const NamedResult& named) const {
  const Hypothesis& hypothesis = sought_.hypotheses[named.hypothesis];
  if (!hypothesis.windowed) return false;
  const double slow = named.best.score.delta_chi2 * (1 - 1 / named.slow_noise);
  if (sought_.net(named, result_.noise) - slow < kEventNet) return true;
  if (hypothesis.shapes.size() > 1) {  // it begins, and ends
    const Eigen::VectorXd& p = named.best.effect.parameters;
    const double duration = p[hypothesis.shapes[1]] - p[hypothesis.shapes[0]];
    if (duration < kShortestCondition * data_.evidence.row_time) return true;
  }
  return is_jolt(system, system.whitened(effect_columns(data_.evidence, data_.signals,
                                                        named.best.effect, {0})));
}

bool EffectConditions::carries_torque(const EvidenceSystem& system, const NamedResult& named,
                                      int joint) const {
  Hypothesis hypothesis = sought_.hypotheses[named.hypothesis];
  std::vector<int> wanted;
  for (const int p : hypothesis.linear) wanted.push_back(1 + p);
  const EffectInstance& event = named.best.effect;
  const JointColumns all =
      effect_columns(data_.evidence, data_.signals, event, wanted, hypothesis.held);
  const auto place = std::find(all.joints.begin(), all.joints.end(), joint);
  if (place == all.joints.end()) return false;
  const Eigen::MatrixXd& own = all.parts[static_cast<std::size_t>(place - all.joints.begin())];
  const auto acting = static_cast<double>((own.rowwise().squaredNorm().array() > 0).count());
  JointColumns columns;
  columns.joints = {joint};
  columns.parts = {own};
  const Products products = system.products(system.whitened(std::move(columns)), false);
  hypothesis.shapes.clear();  // its times are known
  TrialScore trial;
  trial.score = score_of(products, false);
  trial.few = squares_of_few(products);
  trial.part = acting / static_cast<double>(own.rows() * data_.evidence.joints());
  return net_of(hypothesis, trial, result_.noise) > 0;
}

EffectConditions::Beside EffectConditions::beside(const NamedResult& named,
                                                  const EvidenceSystem& system,
                                                  const Screening& screening) const {
  return beside(sought_.net(named, result_.noise), sought_.joints(named.hypothesis), system,
                screening);
}

EffectConditions::Beside EffectConditions::beside(double explained, const std::vector<int>& own,
                                                  const EvidenceSystem& system,
                                                  const Screening& screening) const {
  const auto is_own = [&](int joint) {
    return std::find(own.begin(), own.end(), joint) != own.end();
  };
  // shapes of a strong effect are not quite found yet, and its torque is not quite its derivative's
  const double much = (1 + kOutdonePart) * explained + kOutdone;
  const bool by_function = std::any_of(
      screening.generic.begin(), screening.generic.end(), [&](const GenericResult& generic) {
        const GenericStructure& structure = sought_.structures[generic.structure];
        return structure.is_specific() && is_own(structure.joint) &&
               !stiction_.sticks(structure.joint) &&
               net_of(structure, generic.score, result_.noise) > much;
      });
  if (by_function) return Beside::kOutdone;
  Beside result = Beside::kNothing;
  for (const NamedResult& each : screening.named) {
    if (!each.seen || each.freest.admissible) continue;
    const NamedResult other = without_conditions(each);
    const double net = sought_.net(other, result_.noise);
    const bool by_far = explained < kLeastExplained * net;
    if (much >= net || (!by_far && result == Beside::kBetterForm)) continue;
    const std::vector<int> joints = sought_.joints(other.hypothesis);
    if (!std::any_of(joints.begin(), joints.end(), is_own) ||
        stiction_.hide(system, screening, sought_.hypotheses[other.hypothesis], other)) {
      continue;
    }
    if (by_far) return Beside::kOutdone;
    result = Beside::kBetterForm;
  }
  return result;
}

}  // namespace dyngen::runtime
