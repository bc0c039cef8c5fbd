// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/name_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "runtime/diagnosis/scans/generic_structure.h"

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;

constexpr double kAgree = 3.5;      // standard deviations between two sizes
constexpr double kLeastShown = 12;  // chi-square of the effect that each side must have
constexpr double kAway = 0.02;      // of a joint's range of positions: beyond, a reversal is over
constexpr double kNear = 0.1;       // of it: within, something may still creep
constexpr double kSlowPart = 0.25;  // of the speed that 90 % of the samples are below

/// One joint's equations: the effect there, what is left to explain, and what the joint does.
struct JointView {
  ArrayXd effect, rest;  // whitened
  ArrayXd speed, velocity, load, time, distance;
  double range = 0, v90 = 0;
};

/// 1 on one side, -1 on the other, 0 on neither: of the equations of a joint.
using Divide = std::function<ArrayXd(const JointView&)>;

struct NameTest {
  const char* name;
  const char* first;   ///< "at high speed"
  const char* second;  ///< "at low speed"
  Divide divide;
  bool there = false;  ///< the effect must be seen on the first side, whatever the other says
};

double quantile(const ArrayXd& values, const ArrayXd& weights, double part) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return values[a] < values[b]; });
  const double wanted = part * weights.sum();
  double below = 0;
  for (const Index k : order) {
    below += weights[k];
    if (below >= wanted) return values[k];
  }
  return values.maxCoeff();
}

/// Above and below the value that halves the effect's sum of squares.
ArrayXd halves(const ArrayXd& values, const JointView& view) {
  const double middle = quantile(values, view.effect.square(), 0.5);
  return (values > middle).select(ArrayXd::Ones(values.size()), -ArrayXd::Ones(values.size()));
}

ArrayXd sides(const Eigen::Array<bool, Eigen::Dynamic, 1>& first) {
  return first.select(ArrayXd::Ones(first.size()), -ArrayXd::Ones(first.size()));
}

const std::vector<NameTest>& two_sided() {
  const auto by_speed = [](const JointView& view) { return halves(view.speed, view); };
  const auto by_load = [](const JointView& view) { return halves(view.load.abs(), view); };
  static const std::vector<NameTest> kTests = {
      {"both_directions", "forwards", "backwards",
       [](const JointView& view) { return view.velocity.sign().eval(); }},
      {"speed_independent", "at high speed", "at low speed", by_speed},
      {"speed_scaling", "at high speed", "at low speed", by_speed},
      {"two_loads", "at large loads", "at small loads", by_load},
      {"load_scaling", "at large loads", "at small loads", by_load},
      {"high_load_only", "at large loads", "at small loads", by_load},
      {"monotone", "late", "early", [](const JointView& view) { return halves(view.time, view); }},
      {"slow_steady", "at slow steady speed away from reversals", "elsewhere",
       [](const JointView& view) {
         return sides(view.speed < kSlowPart * view.v90 && view.distance > kAway * view.range);
       },
       true},
      {"load_reversal", "away from reversals of the velocity", "at these",
       [](const JointView& view) { return sides(view.distance > kAway * view.range); }, true},
      {"partner_alone", "while the joint itself is slow", "while it is not",
       [](const JointView& view) { return sides(view.speed < kSlowPart * view.v90); }, true},
      {"distance_collapse", "after fast reversals", "after slow ones", [](const JointView& view) {
         const ArrayXd near = (view.distance < kNear * view.range).cast<double>();
         const double middle = quantile(view.speed, near * view.effect.square(), 0.5);
         return (near * sides(view.speed > middle)).eval();
       }}};
  return kTests;
}

/// What a test needs that these recordings are not asked for.
const std::vector<std::pair<const char*, const char*>>& needs() {
  static const std::vector<std::pair<const char*, const char*>> kNeeds = {
      {"order_match", "needs the numbers of poles, slots or teeth and the gear ratio"},
      {"transposed", "needs a fit of the same coupling on the other joint of the pair"},
      {"distal_silence", "needs the torque of the joints beyond the link without other changes"},
      {"rest_resets", "needs another recording after a rest"},
      {"nested_loops", "needs a motion with small reversals within larger ones"},
      {"time_collapse", "needs events of several speeds"},
      {"onset", "needs the period before and the one after, each by itself"}};
  return kNeeds;
}

/// A size with its precision, from products of an effect with itself and with what is left.
struct Size {
  double squares = 0, product = 0;

  [[nodiscard]] double value() const { return product / squares; }
  [[nodiscard]] double stddev() const { return 1 / std::sqrt(squares); }
};

Size size_where(const JointView& view, const ArrayXd& weight) {
  return {(weight * view.effect.square()).sum(), (weight * view.effect * view.rest).sum()};
}

std::vector<JointView> equation_sets_of(const EffectRecordings& data, EffectSignals& signals,
                                        const EvidenceSystem& system,
                                        const EffectInstance& effect) {
  const JointColumns columns = system.whitened(effect_columns(data, signals, effect, {0}));
  std::vector<JointView> sets;
  for (const int joint : columns.joints) {
    JointView view;
    view.effect = system.left_of(columns, joint).col(0).array();
    view.rest = system.rest(joint).array();
    const auto at_equations = [&](Kind kind, int of) -> ArrayXd {
      return values_at_equations(data, signals, {kind, of});
    };
    view.velocity = at_equations(Kind::kVelocity, joint);
    view.speed = view.velocity.abs();
    view.load = at_equations(Kind::kLoad, joint);
    view.time = at_equations(Kind::kTime, -1);
    view.distance = at_equations(Kind::kDistance, joint);
    const ArrayXd positions = at_equations(Kind::kPosition, joint);
    view.range = positions.maxCoeff() - positions.minCoeff();
    view.v90 = quantile(view.speed, ArrayXd::Ones(view.speed.size()), 0.9);
    sets.push_back(std::move(view));
  }
  return sets;
}

std::string size_text(const Size& size) {
  return fmt::format("{:.2f} +- {:.2f}", size.value(), size.stddev());
}

FalsifierOutcome compared(const NameTest& test, const std::vector<JointView>& sets) {
  Size first, second;
  for (const JointView& view : sets) {
    const ArrayXd side = test.divide(view);
    const Size a = size_where(view, (side > 0).cast<double>()),
               b = size_where(view, (side < 0).cast<double>());
    first = {first.squares + a.squares, first.product + a.product};
    second = {second.squares + b.squares, second.product + b.product};
  }
  for (const auto& [size, where] : {std::pair(first, test.first), {second, test.second}}) {
    if (size.squares >= kLeastShown) continue;
    return {test.name, true,
            fmt::format("these recordings show too little of it {}: chi-square {:.0f}", where,
                        size.squares),
            false};
  }
  const double apart =
      std::abs(first.value() - second.value()) / std::hypot(first.stddev(), second.stddev());
  const bool there = !test.there || first.value() > kAgree * first.stddev();
  return {test.name, apart < kAgree && there,
          fmt::format("of its size {} {} and {} {}", size_text(first), test.first,
                      size_text(second), test.second),
          true};
}

/// One value explains every joint on which the effect shows.
FalsifierOutcome all_joints(const std::vector<JointView>& sets, const std::vector<int>& joints) {
  double sum = 0, product = 0;
  std::vector<Size> sizes;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Size size = size_where(sets[i], ArrayXd::Ones(sets[i].effect.size()));
    if (size.squares < kLeastShown) continue;
    sizes.push_back(size);
    texts.push_back(fmt::format("{} on joint {}", size_text(size), joints[i] + 1));
    sum += size.squares;
    product += size.product;
  }
  if (sizes.size() < 2) {
    return {"all_joints", true,
            fmt::format("these recordings show it on {} joint{} alone", sizes.size(),
                        sizes.size() == 1 ? "" : "s"),
            false};
  }
  const double mean = product / sum;
  double worst = 0;
  for (const Size& size : sizes) {
    worst = std::max(worst, std::abs(size.value() - mean) / size.stddev());
  }
  return {"all_joints", worst < kAgree, fmt::format("of its size {}", fmt::join(texts, ", ")),
          true};
}

}  // namespace

std::vector<FalsifierOutcome> name_tests(const EffectRecordings& data, EffectSignals& signals,
                                         const EvidenceSystem& system,
                                         const EffectInstance& effect) {
  std::vector<FalsifierOutcome> outcomes;
  if (effect.law.tests.empty()) return outcomes;
  const std::vector<JointView> sets = equation_sets_of(data, signals, system, effect);
  for (const std::string& name : effect.law.tests) {
    const auto of_name = [&](const auto& entry) { return name == entry.name; };
    const auto split = std::find_if(two_sided().begin(), two_sided().end(), of_name);
    if (split != two_sided().end()) {
      outcomes.push_back(compared(*split, sets));
    } else if (name == "all_joints") {
      outcomes.push_back(all_joints(sets, joints_of(effect, data.joints())));
    } else {
      const auto need = std::find_if(needs().begin(), needs().end(),
                                     [&](const auto& entry) { return name == entry.first; });
      outcomes.push_back({name, true,
                          need != needs().end() ? need->second : "is not known to the diagnosis",
                          false});
    }
  }
  return outcomes;
}

}  // namespace dyngen::runtime
