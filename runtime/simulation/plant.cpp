// SPDX-License-Identifier: MIT
#include "runtime/simulation/plant.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/simulation/regime.h"

namespace dyngen::runtime {
namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Index;
using Eigen::Map;
using Eigen::VectorXd;
using Values = std::vector<double>;  ///< q, then dq, then the states of effects
using Formula = odeint::runge_kutta_dopri5<Values>;

constexpr double kEventTime = 1e-13;  ///< s

constexpr double kWild = 1e5;  ///< rad, m, rad/s, m/s: no robot is there

std::runtime_error runaway(double time) {
  return std::runtime_error(fmt::format(
      "the motion does not stay bounded after {:.6g} s: expected a stable controller", time));
}

}  // namespace

void PlantModel::validate() const {
  if (joints < 1) {
    throw std::invalid_argument(fmt::format("PlantModel: {} joints, expected 1 or more", joints));
  }
  if (!forward || !rigid || !mass_matrix || !friction) {
    throw std::invalid_argument(
        "PlantModel: expected all of the functions forward, rigid, mass_matrix, friction");
  }
  if (coulomb.size() != joints || !coulomb.allFinite() || (coulomb.array() < 0).any()) {
    throw std::invalid_argument(
        fmt::format("PlantModel: coulomb has {} values, expected {} finite "
                    "ones that are not negative",
                    coulomb.size(), joints));
  }
  const auto outside = [this](int link) { return link < 0 || link >= joints; };
  if (std::any_of(links.begin(), links.end(), outside) ||
      links.size() > static_cast<std::size_t>(joints) || (drives() < joints && !at_rest)) {
    throw std::invalid_argument(
        "PlantModel: expected links that are coordinates, and at_rest where there are springs");
  }
  if (lag.size() != 0 && (lag.size() != drives() || !lag.allFinite() || (lag.array() < 0).any())) {
    throw std::invalid_argument(
        fmt::format("PlantModel: lag has {} values, expected {} finite ones that are not negative",
                    lag.size(), drives()));
  }
}

void IntegrationOptions::validate() const {
  for (const auto& [name, value] :
       {std::pair{"tolerance", tolerance}, std::pair{"max_step", max_step}}) {
    if (!(value > 0) || !std::isfinite(value)) {
      throw std::invalid_argument(
          fmt::format("IntegrationOptions: {} is {}, expected a positive number", name, value));
    }
  }
}

struct Plant::State {
  State(PlantModel model, const IntegrationOptions& chosen)
      : regime(std::move(model)),
        options(chosen),
        controlled(odeint::make_controlled(chosen.tolerance, chosen.tolerance, Formula())),
        n(static_cast<std::size_t>(regime.model.joints)),
        x(2 * n + regime.effect_states()),
        tau(n),
        step(chosen.max_step),
        stuck_time(VectorXd::Zero(regime.model.joints)) {}

  void advance(const TorqueSource& torque, double until);
  void decide(const TorqueSource& torque);
  double try_step(const TorqueSource& torque, double longest, Values& after);
  double least_margin(const TorqueSource& torque, double at, const Values& values);
  void locate(const TorqueSource& torque, double taken, const Values& after);
  void take_event(const TorqueSource& torque, double at, const Values& values);
  void pass(double at, Values values);
  [[nodiscard]] RobotState state(double at, const Values& values) const {
    return {at, values.data(), values.data() + n, values.data() + 2 * n};
  }
  [[nodiscard]] auto system(const TorqueSource& torque) {
    return [this, &torque](const Values& values, Values& rate, double at) {
      const double* q = values.data();
      const double* dq = q + n;
      torque(at, q, dq, tau.data());
      std::copy_n(dq, n, rate.begin());
      regime.accelerate({at, q, dq, dq + n}, tau.data(), rate.data() + n, rate.data() + 2 * n);
    };
  }

  Regime regime;
  IntegrationOptions options;
  odeint::result_of::make_controlled<Formula>::type controlled;
  Formula formula;
  std::size_t n;
  Values x;
  Values tau;
  double time = 0;
  double step;  ///< that the error control proposes
  VectorXd stuck_time;
  PlantCounts counts;
};

/// Who stands, who slides, and where to, at the present state.
void Plant::State::decide(const TorqueSource& torque) {
  const double* dq = x.data() + n;
  bool any_at_rest = false;
  for (std::size_t j = 0; j < n; ++j) {
    const auto i = static_cast<Index>(j);
    regime.direction[i] = sign(dq[j]);
    regime.stuck[i] = false;
  }
  regime.find_dry_joints(state(time, x));
  for (std::size_t j = 0; j < n; ++j) {
    any_at_rest = any_at_rest || (dq[j] == 0 && regime.is_dry(static_cast<Index>(j)));
  }
  controlled.reset();  // the rate at the beginning of the next step is a new one
  if (!any_at_rest) return;
  torque(time, x.data(), dq, tau.data());
  const RestingJoints rest = regime.rest(state(time, x), tau.data());
  for (Index j = 0; j < rest.direction.size(); ++j) {
    if (!regime.is_dry(j) || dq[j] != 0) continue;
    regime.direction[j] = rest.direction[j];
    regime.stuck[j] = rest.direction[j] == 0;
  }
}

/// A step that keeps the tolerance. @return how long it is
double Plant::State::try_step(const TorqueSource& torque, double longest, Values& after) {
  double h = std::min({step, options.max_step, longest});
  const bool cut = h < step;
  for (int attempt = 0; attempt < 100; ++attempt) {
    after = x;
    double at = time;
    const double tried = h;
    if (controlled.try_step(system(torque), after, at, h) == odeint::success) {
      // a step that was cut short says little about how long the next may be
      step = cut && attempt == 0 ? std::max(step, h) : h;
      return tried;
    }
    if (!std::isfinite(h)) break;
  }
  throw runaway(time);
}

/// The smallest distance of all joints from their next event: velocity in the direction of
/// sliding, torque that friction can still hold. Negative: something has happened.
double Plant::State::least_margin(const TorqueSource& torque, double at, const Values& values) {
  double margin = std::numeric_limits<double>::infinity();
  const double* q = values.data();
  const double* dq = q + n;
  for (Index j = 0; j < regime.direction.size(); ++j) {
    if (regime.is_dry(j) && !regime.stuck[j]) {
      margin = std::min(margin, regime.direction[j] * dq[j]);
    }
  }
  if (regime.stuck.any()) {
    torque(at, q, dq, tau.data());
    const Regime::Held held = regime.held(state(at, values), tau.data());
    for (Index j = 0; j < held.torque.size(); ++j) {
      if (!regime.stuck[j]) continue;
      margin = std::min(margin, held.most[j] * (1 + kStictionMargin) - std::abs(held.torque[j]));
    }
  }
  return margin;
}

void Plant::State::pass(double at, Values values) {
  for (Index j = 0; j < stuck_time.size(); ++j) {
    if (regime.stuck[j]) stuck_time[j] += at - time;
  }
  time = at;
  x = std::move(values);
}

/// Finds the first event within a step that ended behind it, and goes there.
void Plant::State::locate(const TorqueSource& torque, double taken, const Values& after) {
  const double start = time;
  Values values = after;
  const auto margin_after = [&](double h) {
    formula.reset();
    formula.do_step(system(torque), x, start, values, h);
    return least_margin(torque, start + h, values);
  };
  double late = taken, late_margin = least_margin(torque, start + taken, after);
  double early = 0, early_margin = 0;
  Values late_values = after;
  // A joint that just began to slide has the margin 0 at the start: the bracket begins where it is
  // positive.
  for (double h = taken / 2; h > kEventTime; h /= 2) {
    const double margin = margin_after(h);
    if (margin >= 0) {
      early = h;
      early_margin = margin;
      break;
    }
    late = h;
    late_margin = margin;
    late_values = values;
  }
  // The Illinois variant of the rule of false position, with a bisection now and then.
  int side = 0;  // which end of the bracket was moved last
  for (int k = 0; late - early > kEventTime && k < 200; ++k) {
    double h = (early * late_margin - late * early_margin) / (late_margin - early_margin);
    if (k % 4 == 3 || !(h > early && h < late)) h = (early + late) / 2;
    const double margin = margin_after(h);
    if (margin >= 0) {
      early = h;
      early_margin = margin;
      if (side == -1) late_margin /= 2;
      side = -1;
    } else {
      late = h;
      late_margin = margin;
      late_values = values;
      if (side == 1) early_margin /= 2;
      side = 1;
    }
  }
  take_event(torque, start + late, late_values);
}

/// Velocities that are zero or reversed become zero; what that means is decided anew.
void Plant::State::take_event(const TorqueSource& torque, double at, const Values& values) {
  pass(at, values);
  bool reversal = false;
  for (Index j = 0; j < regime.direction.size(); ++j) {
    double& dq = x[n + static_cast<std::size_t>(j)];
    if (!regime.is_dry(j) || regime.stuck[j] || regime.direction[j] * dq >= 0) continue;
    dq = 0;
    reversal = true;
  }
  ++(reversal ? counts.reversals : counts.releases);
  decide(torque);
}

void Plant::State::advance(const TorqueSource& torque, double until) {
  decide(torque);
  long events = 0;
  Values after(x.size());
  while (time < until) {
    const double left = until - time;
    const double taken = try_step(torque, left, after);
    ++counts.steps;
    const bool last = taken >= left;
    const auto wild = [](double v) { return !(std::abs(v) < kWild); };
    if (std::any_of(after.begin(), after.end(), wild)) throw runaway(time);
    if (least_margin(torque, time + taken, after) >= 0) {
      pass(last ? until : time + taken, after);
      continue;
    }
    constexpr long kMostEvents = 10000;
    if (++events > kMostEvents) {
      throw std::runtime_error(
          fmt::format("joints begin and cease to stand without end at {:.6g} s", time));
    }
    locate(torque, taken, after);
  }
}

Plant::Plant(PlantModel model, const IntegrationOptions& options, const VectorXd& q,
             const VectorXd& dq) {
  model.validate();
  options.validate();
  if (q.size() != model.joints || dq.size() != model.joints || !q.allFinite() || !dq.allFinite()) {
    throw std::invalid_argument(
        fmt::format("Plant: {} positions and {} velocities, expected {} finite values of each",
                    q.size(), dq.size(), model.joints));
  }
  state_ = std::make_unique<State>(std::move(model), options);
  std::copy(q.begin(), q.end(), state_->x.begin());
  std::copy(dq.begin(), dq.end(), state_->x.begin() + q.size());
  state_->regime.start(state_->state(0, state_->x), state_->x.data() + 2 * state_->n);
}
Plant::~Plant() = default;
Plant::Plant(Plant&&) noexcept = default;
Plant& Plant::operator=(Plant&&) noexcept = default;

void Plant::advance(const TorqueSource& torque, double until) { state_->advance(torque, until); }

double Plant::time() const { return state_->time; }
VectorXd Plant::q() const {
  return Map<const VectorXd>(state_->x.data(), static_cast<Index>(state_->n));
}
VectorXd Plant::dq() const {
  return Map<const VectorXd>(state_->x.data() + state_->n, static_cast<Index>(state_->n));
}
const VectorXd& Plant::stuck_time() const { return state_->stuck_time; }
const PlantCounts& Plant::counts() const { return state_->counts; }

VectorXd Plant::acceleration(const VectorXd& torque) const {
  Regime& regime = state_->regime;
  const double* q = state_->x.data();
  const double* dq = q + state_->n;
  const Eigen::VectorXi before = regime.direction;
  for (Index j = 0; j < torque.size(); ++j) regime.direction[j] = sign(dq[j]);
  VectorXd ddq = regime.rest({time(), q, dq, dq + state_->n}, torque.data()).ddq;
  regime.direction = before;  // what is asked here changes nothing
  return ddq;
}

}  // namespace dyngen::runtime
