// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/screening.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "runtime/diagnosis/order_scan.h"
#include "runtime/diagnosis/time_windows.h"
#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kGrid = 5;  // values of a shape

/// Surprises of noise surrogates: the largest over all tests.
struct NoiseSurprises {
  VectorXd largest;

  void add(const VectorXd& squares, int degrees) {
    if (largest.size() == 0) largest = VectorXd::Zero(squares.size());
    for (Index m = 0; m < squares.size(); ++m) {
      largest[m] = std::max(largest[m], surprise_of(squares[m], degrees));
    }
  }

  /// The smallest of N independent p-values: -ln(1 - p) has the mean 1 / N.
  [[nodiscard]] double tests() const {
    if (largest.size() == 0) return 1;
    double sum = 0;
    for (const double surprise : largest) sum += -std::log1p(-std::min(std::exp(-surprise), 0.999));
    return std::max(1.0, static_cast<double>(largest.size()) / sum);
  }
};

bool better(const TrialScore& a, const TrialScore& b) {
  if (a.admissible != b.admissible) return a.admissible;
  return a.score.squares > b.score.squares;
}

/// Trial shapes of an effect that repeats with position: its order is a peak, or a peak is one of
/// its first harmonics.
std::vector<VectorXd> ordered_grid(const Hypothesis& hypothesis, const EffectScales& scales,
                                   const OrderScan& orders) {
  const EffectSizes sizes = hypothesis.effect.law.sizes(scales);
  std::vector<VectorXd> grid;
  for (const double peak : orders.peaks) {
    for (const double harmonic : {1.0, 2.0, 4.0}) {
      const double value = peak / harmonic;
      const int p = hypothesis.shapes.front();
      if (value < sizes.min[p] || value > sizes.max[p]) continue;
      grid.push_back(VectorXd::Constant(1, value));
    }
  }
  return grid;
}

/// What the typical size of an effect would be worth, at its typical shapes.
void remember_typical(const TrialScore& trial, NamedResult& result) {
  result.typical_lambda = trial.typical_lambda;
  result.part_left = trial.score.part_left;
  result.typical = trial.typical;
}

}  // namespace

double surprise_of(double squares, int degrees) {
  if (degrees == 0 || squares <= 0) return 0;
  const double tail = chi_square_tail(squares, degrees);
  if (tail > 1e-290) return -std::log(tail);
  // leading term for large arguments (Abramowitz and Stegun 1964, 26.4.12)
  const double half = 0.5 * degrees;
  return squares / 2 - (half - 1) * std::log(squares / 2) + std::lgamma(half);
}

double Screening::family_wise(double surprise) const {
  return -std::expm1(tests * std::log1p(-std::exp(-surprise)));
}

Screening screen(const EffectRecordings& data, EffectSignals& signals, CoarseLook& coarse,
                 const EvidenceSystem& system, const ScaleTable& scales, const VectorXd& beta,
                 const std::vector<Hypothesis>& hypotheses,
                 const std::vector<GenericStructure>& structures,
                 const ScreeningProgress& progress) {
  Screening screening;
  NoiseSurprises noise;
  std::map<int, OrderScan> orders;
  const double all = static_cast<double>(hypotheses.size() + structures.size());
  const auto tell = [&](std::size_t place) {
    if (progress) progress(static_cast<double>(place) / all);
  };
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    tell(h);
    const Hypothesis& hypothesis = hypotheses[h];
    NamedResult result;
    result.hypothesis = h;
    const EffectScales here = scales.of(beta, hypothesis.effect);
    const bool fine = !hypothesis.effect.law.states.empty() || hypothesis.ordered;
    const EffectRecordings& looked_at = fine ? data : coarse.data();
    EffectSignals& read = fine ? signals : coarse.signals();
    try {
      TrialScore typical =
          try_hypothesis(looked_at, read, system, hypothesis, hypothesis.effect, here, false);
      remember_typical(typical, result);
      if (hypothesis.windowed) {
        const WindowScan scan = scan_windows(looked_at, read, system, hypothesis);
        VectorXd window(static_cast<Index>(hypothesis.shapes.size()));
        window[0] = scan.begin;
        if (window.size() > 1) window[1] = scan.end;
        result.best = try_hypothesis(looked_at, read, system, hypothesis,
                                     with_shapes(hypothesis, window), here, false);
        noise.add(scan.score.surrogates, scan.score.degrees);
      } else {
        bool first = true;
        std::vector<VectorXd> grid;
        if (hypothesis.ordered && hypothesis.shapes.size() == 1) {
          const int joint = hypothesis.effect.joint;
          const auto [place, added] = orders.try_emplace(joint);
          if (added) {
            place->second = scan_orders(data, system, joint);
            noise.add(place->second.surrogates, 2);
          }
          grid = ordered_grid(hypothesis, here, place->second);
        } else {
          grid = shape_grid(hypothesis, here, kGrid);
        }
        for (const VectorXd& shapes : grid) {
          TrialScore trial = try_hypothesis(looked_at, read, system, hypothesis,
                                            with_shapes(hypothesis, shapes), here, true);
          noise.add(trial.score.surrogates, trial.score.degrees);
          if (first || better(trial, result.best)) result.best = std::move(trial);
          first = false;
        }
      }
      result.seen = std::isfinite(result.best.score.squares) && result.best.score.degrees > 0;
    } catch (const std::invalid_argument&) {
      result.seen = false;  // a signal is missing
    }
    if (result.seen) {
      result.surprise = surprise_of(result.best.score.squares, result.best.score.degrees);
    }
    screening.named.push_back(std::move(result));
  }
  for (std::size_t s = 0; s < structures.size(); ++s) {
    tell(hypotheses.size() + s);
    GenericResult result;
    result.structure = s;
    result.score = score_of(
        system.products(system.whitened(generic_columns(coarse.data(), coarse.signals(), structures[s]))));
    noise.add(result.score.surrogates, result.score.degrees);
    result.surprise = surprise_of(result.score.squares, result.score.degrees);
    screening.generic.push_back(std::move(result));
  }
  screening.tests = noise.tests();
  return screening;
}

TrialScore refined(const EffectRecordings& data, EffectSignals& signals,
                   const EvidenceSystem& system, const Hypothesis& hypothesis, TrialScore best,
                   const EffectScales& scales) {
  constexpr int kHalvings = 6;
  const EffectSizes sizes = hypothesis.effect.law.sizes(scales);
  const auto count = static_cast<Index>(hypothesis.shapes.size());
  VectorXd steps(count);
  std::vector<bool> logarithmic;
  for (Index i = 0; i < count; ++i) {
    const int p = hypothesis.shapes[static_cast<std::size_t>(i)];
    const EffectParameter& parameter =
        hypothesis.effect.law.parameters[static_cast<std::size_t>(p)];
    logarithmic.push_back(parameter.logarithmic && best.effect.parameters[p] > 0);
    const double reach = sizes.max[p] - sizes.min[p];
    const bool scanned = parameter.role == EffectRole::kScanned && std::isfinite(reach);
    steps[i] = hypothesis.ordered ? 0.5 / std::max(scales.q_range, 0.1) : scanned ? reach / 80 : logarithmic.back() ? std::log(2.0)
                       : 0.25 * std::max(std::abs(best.effect.parameters[p]), 1e-6);
    if (scanned) logarithmic.back() = false;
  }
  for (int halving = 0; halving < kHalvings && count > 0; ++halving) {
    for (Index i = 0; i < count; ++i) {
      const int p = hypothesis.shapes[static_cast<std::size_t>(i)];
      for (const int direction : {-1, 1}) {
        EffectInstance trial = best.effect;
        for (const int linear : hypothesis.linear) {
          trial.parameters[linear] = hypothesis.effect.parameters[linear];
        }
        double& value = trial.parameters[p];
        value = logarithmic[static_cast<std::size_t>(i)] ? value * std::exp(direction * steps[i])
                                                         : value + direction * steps[i];
        value = std::clamp(value, sizes.min[p], sizes.max[p]);
        TrialScore next = try_hypothesis(data, signals, system, hypothesis, trial, scales, false);
        if (better(next, best)) {
          best = std::move(next);
          break;
        }
      }
    }
    steps *= 0.5;
  }
  return best;
}

}  // namespace dyngen::runtime
