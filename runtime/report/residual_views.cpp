// SPDX-License-Identifier: MIT
#include "runtime/report/residual_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/report/thinning.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;

constexpr std::size_t kMostVariables = 5;
constexpr double kSplit = 0.7;  // of the spread within bins: what directions must take of it

/// Samples of all runs that count for a joint, one after the other.
class Samples {
 public:
  /// @param recording  the only one that counts; -1: all
  Samples(const EffectRecordings& data, int joint, int recording) : data_(data), joint_(joint) {
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      const bool here = recording < 0 || data.runs[run].recording == recording;
      const std::vector<bool> counted = counted_samples(data.runs[run], joint);
      places_.emplace_back();
      for (std::size_t k = 0; here && k < counted.size(); ++k) {
        if (counted[k]) places_.back().push_back(static_cast<Index>(k));
      }
      size_ += static_cast<Index>(places_.back().size());
    }
  }

  [[nodiscard]] Index size() const { return size_; }

  /// @param of_run  all samples of a run
  template <class OfRun>
  [[nodiscard]] VectorXd values(const OfRun& of_run) const {
    VectorXd all(size_);
    Index next = 0;
    for (std::size_t run = 0; run < places_.size(); ++run) {
      if (places_[run].empty()) continue;
      const VectorXd own = of_run(run);
      for (const Index k : places_[run]) all[next++] = own[k];
    }
    return all;
  }
  [[nodiscard]] VectorXd of(const RunResiduals& residuals) const {
    return values([&](std::size_t run) -> VectorXd { return residuals[run].col(joint_); });
  }
  [[nodiscard]] VectorXd direction() const {
    return values([&](std::size_t run) { return travelled_sign_of(data_, run, joint_); });
  }

 private:
  const EffectRecordings& data_;
  int joint_;
  std::vector<std::vector<Index>> places_;  // of each run
  Index size_ = 0;
};

double rms(const VectorXd& values) {
  return values.size() == 0 ? 0
                            : std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// Spread of values within bins: sum of squares about the mean of each.
double spread(const Bins& bins, const VectorXd& y, const std::vector<bool>& chosen) {
  const BinnedValues means = binned(bins, y, chosen, 1);
  double sum = 0;
  for (std::size_t i = 0; i < bins.of.size(); ++i) {
    if (!chosen.empty() && !chosen[i]) continue;
    const double off = y[static_cast<Index>(i)] - means.mean[bins.of[i]];
    sum += off * off;
  }
  return sum;
}

std::vector<bool> moving(const VectorXd& direction, int way) {
  std::vector<bool> chosen(static_cast<std::size_t>(direction.size()));
  for (Index i = 0; i < direction.size(); ++i) {
    chosen[static_cast<std::size_t>(i)] = direction[i] * way > 0;
  }
  return chosen;
}

/// How often a ripple repeats in a turn of its joint; 0: it is none.
double order_of(const EffectInstance& effect) {
  const auto& parameters = effect.law.parameters;
  const auto& read = effect.law.variables;
  if (std::find(read.begin(), read.end(), "q") == read.end()) return 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (parameters[p].role == EffectRole::kScanned && parameters[p].unit != "s") {
      return effect.parameters[static_cast<Index>(p)];
    }
  }
  return 0;
}

/// Samples of an effect.
struct EffectSamples {
  VectorXd rest;   ///< what is left without it; empty: there is no effect
  VectorXd model;  ///< its torque
  /// Derivatives of that by its parameters; empty: not known.
  MatrixXd gradient;
  MatrixXd covariance;  ///< of its parameters
};

class ViewMaker {
 public:
  ViewMaker(const DiagnosedRecordings& recordings, const ViewBudget& budget)
      : recordings_(recordings),
        train_(recordings.train),
        budget_(budget),
        signals_(recordings.train),
        before_(raw_residuals(train_, recordings.before)),
        after_(raw_residuals(train_, recordings.after)) {
    signals_.set_beta(recordings.after.beta);
    signals_.set_tangent_beta(recordings.after.beta);
    const std::size_t charts =
        recordings.answer.findings.size() + recordings.answer.unexplained.size();
    points_ = std::clamp<Index>(
        budget.points / static_cast<Index>(std::max<std::size_t>(1, charts)), 300, 2000);
  }

  ResidualView finding(std::size_t place, const std::string& plot) {
    const Finding& found = recordings_.answer.findings[place];
    const EffectInstance& effect = recordings_.after.effects[place];
    const RunResiduals others = raw_residuals(train_, without(place));
    const int joint = joint_of(found, others);
    const Samples samples(train_, joint, effect.recording);
    EffectSamples own;
    own.rest = samples.of(others);
    own.model = own.rest - samples.of(after_);
    std::vector<std::string> names = {found.where.variable};
    names.push_back(plot_name(plot, effect, joint));
    for (const char* also : {"qd", "q"}) names.push_back(of_joint(also, joint));
    names.emplace_back("t");
    ResidualView view = view_over(samples, joint, names, found.where, &effect);
    view.size = rms(own.model);
    view.peak = own.model.size() == 0 ? 0 : own.model.cwiseAbs().maxCoeff();
    add_gradient(place, samples, own);
    fill(view, samples, own);
    const std::string wanted = order_of(effect) > 0 ? of_joint("phase", joint) : names[1];
    for (std::size_t i = 0; i < view.over.size(); ++i) {
      if (view.over[i].variable == wanted) view.plot = i;
    }
    return view;
  }

  ResidualView unexplained(const Unexplained& left) {
    const Samples samples(train_, left.joint, -1);
    std::vector<std::string> names = left.variables;
    for (const char* also : {"qd", "q"}) names.push_back(of_joint(also, left.joint));
    names.emplace_back("t");
    ResidualView view = view_over(samples, left.joint, names, {}, nullptr);
    fill(view, samples, {});
    return view;
  }

 private:
  static std::string of_joint(const std::string& variable, int joint) {
    return variable == "t" ? variable : fmt::format("{}{}", variable, joint + 1);
  }

  /// The variable of an effect file on its joint: "qd_other" is the partner's.
  static std::string plot_name(const std::string& plot, const EffectInstance& effect, int joint) {
    const std::string other = "_other";
    const bool of_partner = plot.size() > other.size() && effect.other >= 0 &&
                            plot.compare(plot.size() - other.size(), other.size(), other) == 0;
    if (of_partner) return of_joint(plot.substr(0, plot.size() - other.size()), effect.other);
    return of_joint(plot, effect.joint >= 0 ? effect.joint : joint);
  }

  [[nodiscard]] EffectPoint without(std::size_t place) const {
    EffectPoint point = recordings_.after;
    point.effects.erase(point.effects.begin() + static_cast<std::ptrdiff_t>(place));
    return point;
  }

  /// The joint whose torque the effect changes most, counted in what the noise of each is.
  [[nodiscard]] int joint_of(const Finding& found, const RunResiduals& others) const {
    constexpr double kOwn = 0.1;  // of the largest change: a joint's effect is shown on its joint
    const int own = found.effect.joint;
    if (own >= 0 && found.effect.other < 0 && !found.effect.law.acts_on_all) {
      return own;
    }
    VectorXd change = VectorXd::Zero(train_.joints());
    for (std::size_t run = 0; run < others.size(); ++run) {
      change += (others[run] - after_[run]).colwise().squaredNorm().transpose();
    }
    const VectorXd& noise = recordings_.answer.noise.deviation;
    if (noise.size() == change.size()) {
      change = change.cwiseQuotient(noise.cwiseAbs2().cwiseMax(1e-300));
    }
    Index joint = 0;
    const double most = change.maxCoeff(&joint);
    if (own >= 0 && found.effect.other < 0 && change[own] >= kOwn * most) return own;
    return static_cast<int>(joint);
  }

  /// Derivatives as differences over a deviation of each parameter, which is what a band shows.
  void add_gradient(std::size_t place, const Samples& samples, EffectSamples& own) {
    const EffectFit& fit = recordings_.answer.fit;
    if (place >= fit.covariance.size()) return;
    own.covariance = fit.covariance[place];
    MatrixXd gradient = MatrixXd::Zero(own.model.size(), own.covariance.rows());
    for (Index p = 0; p < gradient.cols(); ++p) {
      const double step = std::sqrt(own.covariance(p, p));
      const EffectParameterFit& known = fit.parameters[place][static_cast<std::size_t>(p)];
      if (!(step > 0) || !std::isfinite(step) || !known.seen || known.at_bound) continue;
      const auto left_at = [&](double change) {
        EffectPoint moved = recordings_.after;
        moved.effects[place].parameters[p] += change;
        return samples.of(raw_residuals(train_, moved));
      };
      gradient.col(p) = (left_at(-0.5 * step) - left_at(0.5 * step)) / step;
      own.gradient = gradient;
    }
  }

  /// The variables, each once, with their bins and the samples that are drawn.
  ResidualView view_over(const Samples& samples, int joint, const std::vector<std::string>& names,
                         const EffectLocation& where, const EffectInstance* effect) {
    ResidualView view;
    view.joint = joint;
    if (samples.size() < 2) return view;
    view.torque = rms(samples.values(
        [&](std::size_t run) -> VectorXd { return train_.runs[run].motion.tau.col(joint); }));
    const auto add = [&](const std::string& name, const VectorXd& x) {
      if (!x.allFinite() || !(x.maxCoeff() > x.minCoeff())) return;
      const bool ranged = name == where.variable;
      bins_.push_back(bins_of(x, ranged ? where.from : 0, ranged ? where.to : 0, budget_.bins));
      view.over.push_back({name, bins_.back().x, {}, x});  // all samples until fill()
    };
    bins_.clear();
    const double order = effect == nullptr ? 0 : order_of(*effect);
    for (const std::string& name : names) {
      if (view.over.size() >= kMostVariables) break;
      const bool known = std::any_of(view.over.begin(), view.over.end(),
                                     [&](const auto& own) { return own.variable == name; });
      const std::optional<StructureVariable> variable = variable_of_name(name);
      if (known || !variable || variable->joint >= train_.joints()) continue;
      add(name, samples.values([&](std::size_t run) {
        return variable_values(train_, signals_, run, *variable);
      }));
    }
    if (order > 0) {
      add(of_joint("phase", joint), samples.values([&](std::size_t run) -> VectorXd {
        const double turn = 2 * std::numbers::pi;
        return train_.runs[run].motion.q.col(joint).unaryExpr([&](double q) {
          const double phase = std::fmod(order * q, turn);
          return phase < 0 ? phase + turn : phase;
        });
      }));
    }
    return view;
  }

  void fill(ResidualView& view, const Samples& samples, const EffectSamples& effect) {
    if (view.over.empty()) return;
    const VectorXd left = samples.of(before_), explained = left - samples.of(after_);
    const VectorXd direction = samples.direction();
    for (std::size_t i = 0; i < view.over.size(); ++i) {
      CoordinateView& over = view.over[i];
      const Bins& bins = bins_[i];
      std::vector<int> ways = {0};
      const VectorXd& shape = effect.model.size() != 0 ? effect.model : left;
      const auto forward = moving(direction, 1), backward = moving(direction, -1);
      const bool own_velocity = over.variable == of_joint("qd", view.joint);
      const double apart = spread(bins, shape, forward) + spread(bins, shape, backward);
      if (own_velocity || apart < kSplit * spread(bins, shape, {})) ways = {1, -1};
      for (const int way : ways) {
        const std::vector<bool> chosen = way == 0   ? std::vector<bool>()
                                         : way == 1 ? forward
                                                    : backward;
        over.directions.push_back(
            {way, {}, {}, {}, binned(bins, explained, chosen).mean, {}, {}, {}, {}, {}, {}});
        DirectionView& own = over.directions.back();
        put(binned(bins, left, chosen), own.left, own.left_low, own.left_high);
        if (effect.model.size() == 0) continue;
        put(binned(bins, effect.rest, chosen), own.effect, own.effect_low, own.effect_high);
        own.model = binned(bins, effect.model, chosen).mean;
        if (effect.gradient.size() == 0) continue;
        const VectorXd half = band(bins, chosen, effect);
        own.model_low = own.model - half;
        own.model_high = own.model + half;
      }
    }
    draw(view, left, effect.rest, direction);
  }

  static void put(const BinnedValues& values, VectorXd& mean, VectorXd& low, VectorXd& high) {
    mean = values.mean;
    low = values.low;
    high = values.high;
  }

  /// Half the interval of 95 % of the mean of a bin.
  [[nodiscard]] VectorXd band(const Bins& bins, const std::vector<bool>& chosen,
                              const EffectSamples& effect) const {
    MatrixXd mean(bins.x.size(), effect.gradient.cols());
    for (Index p = 0; p < mean.cols(); ++p) {
      mean.col(p) = binned(bins, effect.gradient.col(p), chosen).mean;
    }
    VectorXd half(bins.x.size());
    for (Index b = 0; b < half.size(); ++b) {
      const double variance = mean.row(b) * effect.covariance * mean.row(b).transpose();
      half[b] = recordings_.answer.fit.interval * std::sqrt(std::max(0.0, variance));
    }
    return half;
  }

  void draw(ResidualView& view, const VectorXd& left, const VectorXd& rest,
            const VectorXd& direction) const {
    const std::vector<Index> drawn = drawn_samples(left, points_);
    const auto count = static_cast<Index>(drawn.size());
    const auto chosen = [&](const VectorXd& all) {
      VectorXd some(count);
      for (Index i = 0; i < count; ++i) some[i] = all[drawn[static_cast<std::size_t>(i)]];
      return some;
    };
    view.left = chosen(left);
    if (rest.size() != 0) view.effect = chosen(rest);
    view.direction = chosen(direction).cast<int>();
    for (CoordinateView& over : view.over) over.cloud_x = chosen(over.cloud_x);
  }

  const DiagnosedRecordings& recordings_;
  const EffectRecordings& train_;
  const ViewBudget& budget_;
  EffectSignals signals_;
  RunResiduals before_, after_;
  Index points_ = 0;
  std::vector<Bins> bins_;  // of the variables of the view that is made
};

std::vector<HeldoutView> heldout_views(const DiagnosedRecordings& recordings,
                                       const ViewBudget& budget) {
  const EffectRecordings& data = recordings.heldout;
  const RunResiduals before = raw_residuals(data, recordings.before);
  const RunResiduals after = raw_residuals(data, recordings.after);
  double all = 0;
  for (const EffectRun& run : data.runs) all += static_cast<double>(run.motion.samples());
  const Index n = data.joints();
  std::vector<HeldoutView> views;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const MatrixXd& torque = here.motion.tau;
    MatrixXd signals(torque.rows(), 4 * n);
    signals << torque, torque - after[run], before[run], after[run];
    const double share = static_cast<double>(torque.rows()) / all;
    const ThinnedSignals thin =
        thinned_signals(here.time, signals, heldout_slices(budget, n, share));
    const auto place = static_cast<std::size_t>(-1 - here.recording);
    HeldoutView view{place < recordings.heldout_names.size() ? recordings.heldout_names[place] : "",
                     thin.x,
                     thin.y.leftCols(n),
                     thin.y.middleCols(n, n),
                     thin.y.middleCols(2 * n, n),
                     thin.y.rightCols(n)};
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace

Index heldout_slices(const ViewBudget& budget, Index joints, double share) {
  constexpr Index kMost = 3000;  // more than a chart has pixels, for a zoom or two
  const double values = static_cast<double>(budget.values) * share;  // four signals, two of each
  return std::clamp<Index>(static_cast<Index>(values / static_cast<double>(8 * joints)), 1, kMost);
}

DiagnosisViews views_for_report(const DiagnosedRecordings& recordings,
                                const std::vector<std::string>& plots, const ViewBudget& budget) {
  DiagnosisViews views;
  ViewMaker maker(recordings, budget);
  for (std::size_t i = 0; i < recordings.after.effects.size(); ++i) {
    views.findings.push_back(maker.finding(i, i < plots.size() ? plots[i] : std::string()));
  }
  for (const Unexplained& left : recordings.answer.unexplained) {
    views.unexplained.push_back(maker.unexplained(left));
  }
  views.heldout = heldout_views(recordings, budget);
  return views;
}

}  // namespace dyngen::runtime
