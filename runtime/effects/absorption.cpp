// SPDX-License-Identifier: MIT
#include "runtime/effects/absorption.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/equation_stack.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kAllAbsorbed = 1 - 1e-9;

/// The first linear parameter that is not typically 0, else the first that is not given.
int main_parameter(const EffectLaw& law, const VectorXd& typical) {
  for (const bool linear : {true, false}) {
    for (int p = 0; p < law.size(); ++p) {
      const EffectRole role = law.parameters[static_cast<std::size_t>(p)].role;
      const bool fits =
          linear ? role == EffectRole::kLinear && typical[p] != 0 : role != EffectRole::kGiven;
      if (fits) return p;
    }
  }
  return -1;
}

/// How far a linear parameter is from where the effect vanishes, all others kept.
double distance_from_nothing(const MatrixXd& columns, int parameter, double typical) {
  const VectorXd slope = columns.col(1 + parameter);
  const double squares = slope.squaredNorm();
  if (!(squares > 0)) return typical;
  const double distance = slope.dot(columns.col(0)) / squares;
  const double rest = (columns.col(0) - distance * slope).squaredNorm();
  // it alone makes the effect, or others make a part of it
  return rest <= 1e-12 * columns.col(0).squaredNorm() ? distance : typical;
}

class Atlas {
 public:
  Atlas(const EffectRecordings& data, const VectorXd& beta, const AtlasNoise& noise,
        std::size_t entries)
      : data_(data),
        noise_(noise),
        signals_(data),
        scales_(data),
        beta_(beta),
        stack_(data, Whitening{quick_noise(noise.joints)}),
        projection_(regressor()),
        left_(MatrixXd::Zero(stack_.rows(), static_cast<Index>(entries))) {
    signals_.set_beta(beta);
    signals_.set_tangent_beta(beta);
  }

  AtlasEntry entry(EffectInstance effect) {
    AtlasEntry entry;
    const EffectSizes sizes = effect.law.sizes(scales_.of(beta_, effect));
    effect.parameters = sizes.typical;
    entry.effect = effect;
    entry.name = short_name(effect);
    entry.parameter = main_parameter(effect.law, sizes.typical);
    entry.typical = entry.parameter < 0 ? 0 : sizes.typical[entry.parameter];
    const Index place = entries_++;
    MatrixXd plain;
    try {
      plain = stack_.plain(signals_, effect);
    } catch (const MissingSignalError& error) {
      entry.missing = error.what();
      return entry;
    }
    if (!plain.allFinite()) {
      entry.missing = "its torque is not finite on this motion";
      return entry;
    }
    entry.enr_before = rms_over_noise(plain.col(0));
    const MatrixXd columns = stack_.whitened(std::move(plain));
    const VectorXd psi = columns.col(0);
    const double squares = psi.squaredNorm();
    if (!(squares > 0)) {
      entry.missing = "this motion does not excite it, or its typical size is 0 here";
      return entry;
    }
    const VectorXd left = projection_.rest(psi);
    entry.lambda = left.squaredNorm();
    entry.absorbed = std::clamp(1 - entry.lambda / squares, 0.0, 1.0);
    if (entry.absorbed >= kAllAbsorbed) {
      const auto& aliases = effect.law.aliases;
      const bool theorem = std::find(aliases.begin(), aliases.end(), "base") != aliases.end();
      entry.kind = theorem ? Absorbed::kOnAnyData : Absorbed::kByThisMotion;
    }
    entry.enr_left = entry.enr_before * std::sqrt(entry.lambda / squares);
    entry.worth = entry.lambda / (entry.enr_left * entry.enr_left);
    const double change = entry.parameter < 0 ? 0
                          : linear(effect, entry.parameter)
                              ? distance_from_nothing(columns, entry.parameter, entry.typical)
                              : entry.typical;
    entry.detectable = entry.kind == Absorbed::kPartly
                           ? std::abs(change) * std::sqrt(kDetectableLambda / entry.lambda)
                           : std::numeric_limits<double>::infinity();
    if (entry.kind == Absorbed::kPartly) left_.col(place) = left.normalized();
    return entry;
  }

  [[nodiscard]] MatrixXd likeness() const { return (left_.transpose() * left_).cwiseAbs(); }

 private:
  static bool linear(const EffectInstance& effect, int parameter) {
    return effect.law.parameters[static_cast<std::size_t>(parameter)].role == EffectRole::kLinear;
  }

  MatrixXd regressor() {
    const EffectPoint nothing = at_rest(data_, beta_, {});
    const MatrixXd all =
        stack_.stacked(linearised(data_, signals_, nothing, base_unknowns(nothing)));
    return all.leftCols(data_.model.size());
  }

  /// Of the joints on which the effect has a torque. @param torque  of all equations
  [[nodiscard]] double rms_over_noise(const VectorXd& torque) const {
    double squares = 0, rows = 0;
    for (int j = 0; j < data_.joints(); ++j) {
      const double of_joint = torque.segment(stack_.first(j), stack_.of_joint()).squaredNorm();
      if (of_joint == 0) continue;
      const double deviation = noise_.joints[static_cast<std::size_t>(j)].deviation;
      squares += of_joint / (deviation * deviation);
      rows += static_cast<double>(stack_.of_joint());
    }
    return rows > 0 ? std::sqrt(squares / rows) : 0;
  }

  const EffectRecordings& data_;
  const AtlasNoise& noise_;
  EffectSignals signals_;
  ScaleTable scales_;
  VectorXd beta_;
  EquationStack stack_;
  Projection projection_;
  MatrixXd left_;  // of each entry, of unit length; 0: nothing is left
  Index entries_ = 0;
};

}  // namespace

AtlasNoise white_noise(const VectorXd& deviation) {
  AtlasNoise noise;
  for (const double sigma : deviation) {
    if (!(sigma > 0)) {
      throw std::invalid_argument(
          fmt::format("atlas: noise of {}, expected positive standard deviations", sigma));
    }
    AutoregressiveNoise white;
    white.deviation = white.innovation = sigma;
    noise.joints.push_back(white);
  }
  return noise;
}

AtlasNoise residual_noise(const EffectRecordings& data, const VectorXd& beta) {
  constexpr Index kLags = 40;
  const RowSource rows = [&data](const std::function<void(const RowBlock&)>& visit) {
    for (const EffectRun& run : data.runs) visit(run.rows);
  };
  const ResidualAutocovariance covariance = residual_autocovariance(rows, beta, kLags);
  AtlasNoise noise;
  for (Index j = 0; j < covariance.lags.cols(); ++j) {
    noise.joints.push_back(
        fit_autoregression(covariance.lags.col(j), std::max(covariance.samples[j], 1.0)));
    if (noise.joints.back().innovation > 0) continue;
    throw std::invalid_argument(
        fmt::format("atlas: the residual of joint {} is 0: noise must be given", j + 1));
  }
  return noise;
}

std::vector<std::size_t> AbsorptionAtlas::nearest(std::size_t entry, std::size_t most) const {
  std::vector<std::size_t> places(entries.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::erase(places, entry);
  const auto row = likeness.row(static_cast<Index>(entry));
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return row[static_cast<Index>(a)] > row[static_cast<Index>(b)];
  });
  if (places.size() > most) places.resize(most);
  return places;
}

std::vector<EffectInstance> atlas_effects(const LinearModel& model,
                                          const std::vector<EffectLaw>& laws,
                                          const std::vector<std::pair<int, int>>& pairs) {
  const int n = model.joints();
  std::set<std::pair<int, int>> coupled;
  for (int j = 0; j + 1 < n; ++j) coupled.insert({{j, j + 1}, {j + 1, j}});
  for (const auto& [joint, other] : pairs) coupled.insert({{joint, other}, {other, joint}});
  std::vector<EffectInstance> effects;
  for (const EffectLaw& law : laws) {
    const auto add = [&](int joint, int other) {
      if (law.revolute_only && joint >= 0 && !model.revolute[static_cast<std::size_t>(joint)]) {
        return;
      }
      EffectInstance effect;
      effect.law = law;
      effect.joint = joint;
      effect.other = other;
      effects.push_back(std::move(effect));
    };
    if (law.scope == EffectScope::kRobot) {
      add(-1, -1);
    } else if (law.scope == EffectScope::kPair) {
      for (const auto& [joint, other] : coupled) add(joint, other);
    } else {
      for (int j = 0; j < n; ++j) add(j, -1);
    }
  }
  return effects;
}

AbsorptionAtlas absorption_atlas(const EffectRecordings& data, const VectorXd& beta,
                                 const AtlasNoise& noise, std::vector<EffectInstance> effects,
                                 const AtlasProgress& progress) {
  if (beta.size() != data.model.size() || static_cast<int>(noise.joints.size()) != data.joints()) {
    throw std::invalid_argument(
        fmt::format("absorption_atlas(): {} parameters and noise of {} joints, expected {} and {}",
                    beta.size(), noise.joints.size(), data.model.size(), data.joints()));
  }
  Atlas atlas(data, beta, noise, effects.size());
  AbsorptionAtlas result;
  for (EffectInstance& effect : effects) {
    if (progress) progress(effect.law.name, result.entries.size(), effects.size());
    result.entries.push_back(atlas.entry(std::move(effect)));
  }
  result.likeness = atlas.likeness();
  return result;
}

}  // namespace dyngen::runtime
