// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/screening.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/diagnosis/scans/in_parallel.h"
#include "runtime/diagnosis/scans/order_scan.h"
#include "runtime/diagnosis/scans/structure_screening.h"
#include "runtime/diagnosis/scans/time_windows.h"
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

  void add(const NoiseSurprises& other) {
    if (other.largest.size() == 0) return;
    largest = largest.size() == 0 ? other.largest : largest.cwiseMax(other.largest).eval();
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
  return a.priced() > b.priced();
}

/// Trial shapes of an effect that repeats with position: its order is a peak, or a peak is one of
/// its first harmonics.
std::vector<VectorXd> ordered_grid(const Hypothesis& hypothesis, const EffectScales& scales,
                                   const OrderScan& orders) {
  const EffectSizes sizes = hypothesis.effect.law.sizes(scales);
  std::vector<VectorXd> grid;
  const bool harmonics = hypothesis.linear.size() > 2;
  for (const double peak : is_position_error(hypothesis) ? orders.error_peaks : orders.peaks) {
    for (const double harmonic : {1.0, 2.0, 4.0}) {
      if (harmonic > 1 && !harmonics) continue;
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

/// One screening: its parts are independent of one another.
class Screener {
 public:
  Screener(ScreeningData& data, const EvidenceSystem& system, const ScaleTable& scales,
           const VectorXd& beta, const std::vector<Hypothesis>& hypotheses,
           const std::vector<GenericStructure>& structures, const Screening* before,
           const std::vector<GenericResult>& known)
      : data_(data),
        system_(system),
        scales_(scales),
        beta_(beta),
        hypotheses_(hypotheses),
        structures_(structures),
        before_(before),
        known_(known) {}

  Screening run(const ScreeningProgress& progress) {
    Screening screening;
    screening.named.resize(hypotheses_.size());
    screening.generic.resize(structures_.size());
    orders_.resize(static_cast<std::size_t>(data_.whole().joints()));
    std::vector<NoiseSurprises> noise(data_.readers().size());
    // orders first: hypotheses read their peaks
    const std::size_t threads = data_.readers().size();
    const bool ordered = std::any_of(hypotheses_.begin(), hypotheses_.end(),
                                     [](const Hypothesis& own) { return own.ordered; });
    in_parallel(ordered ? orders_.size() : 0, threads, [&](std::size_t joint, std::size_t thread) {
      orders_[joint] = scan_orders(data_.whole(), system_, static_cast<int>(joint), !before_);
      if (!before_) noise[thread].add(orders_[joint].surrogates, 2);
    });
    const auto groups = structure_groups(structures_);
    const auto piece = [&](std::size_t place, std::size_t thread) {
      ScreeningData::Reader& reader = data_.readers()[thread];
      if (place < hypotheses_.size()) {
        screening.named[place] = named(place, reader, noise[thread]);
        return;
      }
      for (GenericResult& result : screen_structures(
               data_, reader, system_, structures_, groups[place - hypotheses_.size()], !before_)) {
        screening.generic[result.structure] = std::move(result);
      }
    };
    in_parallel(hypotheses_.size() + (known_.empty() ? groups.size() : 0), threads, piece,
                progress);
    if (!known_.empty()) screening.generic = known_;
    for (const GenericResult& result : screening.generic) {
      if (!before_) noise.front().add(result.score.surrogates, result.score.degrees);
    }
    if (before_) {
      screening.tests = before_->tests;
    } else {
      NoiseSurprises all;
      for (const NoiseSurprises& part : noise) all.add(part);
      screening.tests = all.tests();
    }
    return screening;
  }

 private:
  /// Trial shapes that are worth a look.
  [[nodiscard]] std::vector<EffectInstance> trials(std::size_t place,
                                                   const EffectScales& scales) const {
    const Hypothesis& hypothesis = hypotheses_[place];
    std::vector<VectorXd> grid;
    if (hypothesis.ordered && hypothesis.shapes.size() == 1) {
      grid = ordered_grid(hypothesis, scales,
                          orders_[static_cast<std::size_t>(hypothesis.effect.joint)]);
    } else if (before_ && before_->named[place].seen) {
      const NamedResult& earlier = before_->named[place];
      for (const TrialScore* trial : {&earlier.best, &earlier.freest}) {
        VectorXd shapes(static_cast<Index>(hypothesis.shapes.size()));
        for (Index i = 0; i < shapes.size(); ++i) {
          shapes[i] = trial->effect.parameters[hypothesis.shapes[static_cast<std::size_t>(i)]];
        }
        if (grid.empty() || shapes != grid.front()) grid.push_back(std::move(shapes));
      }
    } else {
      grid = shape_grid(hypothesis, scales, kGrid);
    }
    std::vector<EffectInstance> trials;
    for (const VectorXd& shapes : grid) trials.push_back(with_shapes(hypothesis, shapes));
    return trials;
  }

  NamedResult named(std::size_t place, ScreeningData::Reader& reader, NoiseSurprises& noise) const {
    const Hypothesis& hypothesis = hypotheses_[place];
    NamedResult result;
    result.hypothesis = place;
    const EffectScales scales = scales_.of(beta_, hypothesis.effect);
    const EffectRecordings& data = hypothesis.fast ? data_.whole() : data_.coarse();
    EffectSignals& signals = hypothesis.fast ? reader.whole : reader.coarse;
    try {
      if (before_) {
        const NamedResult& earlier = before_->named[place];
        result.typical_lambda = earlier.typical_lambda;
        result.part_left = earlier.part_left;
        result.typical = earlier.typical;
      } else {
        remember_typical(
            try_hypothesis(data, signals, system_, hypothesis, hypothesis.effect, scales, false),
            result);
      }
      if (hypothesis.windowed) {
        const WindowScan scan = scan_windows(data, signals, system_, hypothesis, !before_);
        VectorXd window(static_cast<Index>(hypothesis.shapes.size()));
        window[0] = scan.begin;
        if (window.size() > 1) window[1] = scan.end;
        EffectInstance event = with_shapes(hypothesis, window);
        event.recording = scan.recording;
        result.slow_noise = scan.elsewhere;
        result.best = try_hypothesis(data, signals, system_, hypothesis, event, scales, false);
        result.freest = result.best;
        if (!before_) noise.add(scan.score.surrogates, scan.score.degrees);
      } else {
        bool first = true;
        for (TrialScore& trial : try_shapes(data, signals, system_, hypothesis,
                                            trials(place, scales), scales, !before_)) {
          if (!before_) noise.add(trial.score.surrogates, trial.score.degrees);
          if (first || trial.priced() > result.freest.priced()) result.freest = trial;
          if (first || better(trial, result.best)) result.best = std::move(trial);
          first = false;
        }
      }
      result.seen = std::isfinite(result.best.score.delta_chi2) && result.best.score.degrees > 0;
    } catch (const MissingSignalError&) {
      result.seen = false;
    }
    for (const int joint : joints_of(hypothesis.effect, data_.whole().joints())) {
      result.worth = std::min(result.worth, system_.worth(joint));
    }
    if (result.seen) result.surprise = surprise_of(result);
    return result;
  }

  ScreeningData& data_;
  const EvidenceSystem& system_;
  const ScaleTable& scales_;
  const VectorXd& beta_;
  const std::vector<Hypothesis>& hypotheses_;
  const std::vector<GenericStructure>& structures_;
  const Screening* before_;
  const std::vector<GenericResult>& known_;
  std::vector<OrderScan> orders_;
};

}  // namespace

double surprise_of(double squares, int degrees) {
  if (degrees == 0 || squares <= 0) return 0;
  const double tail = chi_square_tail(squares, degrees);
  if (tail > 1e-290) return -std::log(tail);
  // leading term for large arguments (Abramowitz and Stegun 1964, 26.4.12)
  const double half = 0.5 * degrees;
  return squares / 2 - (half - 1) * std::log(squares / 2) + std::lgamma(half);
}

double surprise_of(double squares, int degrees, double worth) {
  if (degrees == 0 || squares <= 0) return 0;
  const double tail = variance_ratio_tail(squares / degrees, degrees, worth);
  if (tail > 1e-290) return -std::log(tail);
  // leading term of the incomplete beta function (Abramowitz and Stegun 1964, 26.5.4)
  const double a = worth / 2, b = 0.5 * degrees, x = worth / (worth + squares);
  return -a * std::log(x) - (b - 1) * std::log1p(-x) + std::log(a) + std::lgamma(a) +
         std::lgamma(b) - std::lgamma(a + b);
}

double surprise_of(const NamedResult& named) {
  return surprise_of(named.best.score.delta_chi2 / named.slow_noise, named.best.score.degrees,
                     named.worth);
}

int degrees_of_refined(const NamedResult& named, const Hypothesis& hypothesis) {
  return named.best.score.degrees + static_cast<int>(hypothesis.shapes.size());
}

double surprise_of_refined(const NamedResult& named, const Hypothesis& hypothesis) {
  const double searched = surprise_of(named.best.score.delta_chi2 / named.slow_noise,
                                      degrees_of_refined(named, hypothesis), named.worth);
  return std::max(named.surprise, searched);
}

NamedResult without_conditions(const NamedResult& named) {
  NamedResult free = named;
  free.best = named.freest;
  free.surprise = surprise_of(free);
  return free;
}

double Screening::family_wise(double surprise) const {
  return -std::expm1(tests * std::log1p(-std::exp(-surprise)));
}

double Screening::threshold(double false_alarm) const {
  return -std::log(-std::expm1(std::log1p(-false_alarm) / tests));
}

double detectable_lambda(double surprise) {
  constexpr double kNineInTen = 1.2816;  // of the standard normal distribution
  double least = 0, most = 2 * surprise + 2;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (least + most) / 2;
    (surprise_of(middle, 1) < surprise ? least : most) = middle;
  }
  return std::pow(std::sqrt(most) + kNineInTen, 2);
}

ScreeningData::ScreeningData(const EffectRecordings& data)
    : whole_(data), coarse_(thinned(data)), repeats_(repeats_of(data)) {
  for (std::size_t i = 0; i < working_threads(); ++i) {
    readers_.push_back({EffectSignals(whole_), EffectSignals(coarse_)});
  }
}

void ScreeningData::set_beta(const VectorXd& beta) {
  for (Reader& reader : readers_) {
    for (EffectSignals* signals : {&reader.whole, &reader.coarse}) {
      signals->set_beta(beta);
      signals->set_tangent_beta(beta);
    }
  }
}

Screening screen(ScreeningData& data, const EvidenceSystem& system, const ScaleTable& scales,
                 const VectorXd& beta, const std::vector<Hypothesis>& hypotheses,
                 const std::vector<GenericStructure>& structures, const Screening* before,
                 const ScreeningProgress& progress, const std::vector<GenericResult>& known) {
  data.set_beta(beta);
  return Screener(data, system, scales, beta, hypotheses, structures, before, known).run(progress);
}

TrialScore refined(const EffectRecordings& data, EffectSignals& signals,
                   const EvidenceSystem& system, const Hypothesis& hypothesis, TrialScore best,
                   const EffectScales& scales) {
  constexpr int kHalvings = 6, kHalvingsOfScans = 9;
  std::optional<TrialScore> usual;  // the last that was best, before one that pays for more
  const auto tried = [&](EffectInstance trial) {
    for (const int linear : hypothesis.linear) {
      trial.parameters[linear] = hypothesis.effect.parameters[linear];
    }
    return try_hypothesis(data, signals, system, hypothesis, trial, scales, false);
  };
  const EffectSizes sizes = hypothesis.effect.law.sizes(scales);
  const auto count = static_cast<Index>(hypothesis.shapes.size());
  VectorXd steps(count);
  std::vector<bool> logarithmic;
  int most_halvings = kHalvings;
  for (Index i = 0; i < count; ++i) {
    const int p = hypothesis.shapes[static_cast<std::size_t>(i)];
    const EffectParameter& parameter =
        hypothesis.effect.law.parameters[static_cast<std::size_t>(p)];
    logarithmic.push_back(parameter.logarithmic && best.effect.parameters[p] > 0);
    const double reach = sizes.max[p] - sizes.min[p];
    const bool scanned = parameter.role == EffectRole::kScanned && std::isfinite(reach);
    steps[i] = hypothesis.ordered   ? 0.5 / std::max(scales.q_range, 0.1)
               : scanned            ? reach / (2 * grid_values(parameter))
               : logarithmic.back() ? std::log(2.0)
                                    : 0.25 * std::max(std::abs(best.effect.parameters[p]), 1e-6);
    if (!scanned) continue;
    logarithmic.back() = false;
    most_halvings = kHalvingsOfScans;
  }
  const int halvings = hypothesis.ordered ? kHalvings : most_halvings;
  for (int halving = 0; halving < halvings && count > 0; ++halving) {
    for (Index i = 0; i < count; ++i) {
      const int p = hypothesis.shapes[static_cast<std::size_t>(i)];
      for (const int direction : {-1, 1}) {
        EffectInstance trial = best.effect;
        double& value = trial.parameters[p];
        value = logarithmic[static_cast<std::size_t>(i)] ? value * std::exp(direction * steps[i])
                                                         : value + direction * steps[i];
        value = std::clamp(value, sizes.min[p], sizes.max[p]);
        TrialScore next = tried(trial);
        if (better(next, best)) {
          if (next.unusual > best.unusual) usual = best;
          best = std::move(next);
          break;
        }
      }
    }
    steps *= 0.5;
  }
  if (!usual || usual->unusual >= best.unusual) return best;
  // at the limit of the usual range, between both
  EffectInstance beyond = best.effect;
  for (int halving = 0; halving < 2 * kHalvings; ++halving) {
    EffectInstance middle = usual->effect;
    middle.parameters = 0.5 * (middle.parameters + beyond.parameters);
    TrialScore next = tried(middle);
    if (next.unusual > usual->unusual) {
      beyond = std::move(middle);
    } else {
      usual = std::move(next);
    }
  }
  return better(*usual, best) ? *usual : best;
}

}  // namespace dyngen::runtime
