// SPDX-License-Identifier: MIT
#include "runtime/plausibility/model_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/plausibility/readings.h"
#include "runtime/plausibility/sign_remarks.h"
#include "runtime/plausibility/trial_fit.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// All of torque that a plain fit leaves, as a part of it (norms), of the joint that is worst.
constexpr double kSuspicious = 0.03;   // from here on other readings are tried, and other gravity
constexpr double kFarBetter = 0.4;     // of what is left: another reading is meant
constexpr double kNotMuchWorse = 1.2;  // what it may leave of other joints
constexpr double kMuchIsLeft = 0.3;  // from here on any gravity is tried, and many turns are asked
constexpr double kMuch = 0.5;        // said, if nothing explains it
constexpr double kGravityBetter = 0.5;
constexpr double kCertainlyNegative = 5;  // standard deviations
constexpr double kLagMatters = 0.01;      // from here on lags are tried
constexpr double kLagBetter = 0.5;
constexpr double kLagTried = 0.05;         // s
constexpr double kManyTurns = 25;          // rad: four turns
constexpr double kStandardGravity = 9.81;  // m/s^2
/// kg/m^3: what arms weigh, over the cube of their reach (UR5 30, KR300 70), and how far beyond
/// that is no arm.
constexpr double kArmDensity = 70, kNoArm = 20;

/// Whether another reading leaves far less where most is left, and not much more elsewhere.
bool far_better(const VectorXd& plain, const VectorXd& other, double ratio) {
  Index worst = 0;
  plain.maxCoeff(&worst);
  const double floor = 0.02;  // below that any reading is good
  for (Index j = 0; j < plain.size(); ++j) {
    if (other[j] > std::max(kNotMuchWorse * plain[j], floor)) return false;
  }
  return other[worst] <= ratio * plain[worst];
}

class ModelJudge {
 public:
  ModelJudge(const JudgedRobot& robot, const TrialSamples& samples, std::vector<Remark>& remarks)
      : robot_(robot),
        model_(*robot.model),
        samples_(samples),
        remarks_(remarks),
        plain_(samples.fit(model_, Reading::plain(model_.joints()))),
        deviations_(deviations_of(plain_)) {
    for (const JointFactor& joint : plain_.equations.joints) judged_.push_back(joint.rows > 0);
  }

  void run(double farthest) {
    if (plain_.equations.samples() <= 2.0 * model_.size()) return;
    const std::size_t before = remarks_.size();
    add_sign_remarks(model_, samples_, plain_, remarks_);
    if (refused_since(before)) return;
    const double most = plain_.left.maxCoeff();
    const std::optional<int> impossible = negative_parameter();
    const bool suspicious = most >= kSuspicious || impossible;
    if (suspicious && other_reading()) return;
    if (suspicious && other_gravity(most >= kMuchIsLeft)) return;
    if (most >= kMuchIsLeft && many_turns(farthest)) return;
    torque_unit();
    if (plain_.left.maxCoeff() >= kLagMatters) lags();
    if (remarks_.size() > before) return;
    if (impossible) {
      no_body(*impossible);
    } else if (most >= kMuch) {
      much_is_left();
    }
  }

 private:
  [[nodiscard]] bool refused_since(std::size_t place) const {
    return std::any_of(remarks_.begin() + static_cast<std::ptrdiff_t>(place), remarks_.end(),
                       [](const Remark& remark) { return remark.refused; });
  }

  void refuse(const std::string& kind, int joint, std::string text) {
    remarks_.push_back({kind, true, joint, "", std::move(text)});
  }

  [[nodiscard]] std::string left_words(const VectorXd& other) const {
    Index worst = 0;
    plain_.left.maxCoeff(&worst);
    return fmt::format("then {:.2g} % of joint {}'s torque is left, as it stands {:.2g} %",
                       100 * other[worst], worst + 1, 100 * plain_.left[worst]);
  }

  /// The reading that leaves least of several; none if there are none.
  [[nodiscard]] std::optional<std::pair<NamedReading, TrialFit>> best_of(
      std::vector<NamedReading> readings) const {
    std::optional<std::pair<NamedReading, TrialFit>> best;
    for (NamedReading& reading : readings) {
      TrialFit fit = samples_.fit(model_, reading.reading);
      // signs that are mended make a robot's inertia positive
      if ((fit.inertia.array() < 0).any()) continue;
      if (!best || fit.left.squaredNorm() < best->second.left.squaredNorm()) {
        best.emplace(std::move(reading), std::move(fit));
      }
    }
    return best;
  }

  bool named(const std::optional<std::pair<NamedReading, TrialFit>>& found) {
    if (!found || !far_better(plain_.left, found->second.left, kFarBetter)) return false;
    const NamedReading& reading = found->first;
    refuse(reading.kind, reading.joint,
           fmt::format("{} ({}); {}", reading.what, left_words(found->second.left), reading.cure));
    return true;
  }

  bool other_reading() {
    const Reading base = Reading::plain(model_.joints());
    if (named(best_of(other_units(model_, base)))) return true;
    Index worst = 0;
    plain_.left.maxCoeff(&worst);
    const int joint = static_cast<int>(worst);
    if (named(best_of(swapped_columns(base, joint, samples_.moving_with(joint))))) return true;
    return turned(base);
  }

  /// Signs, one after the other while each leaves less: several may be turned.
  bool turned(const Reading& base) {
    Reading reading = base;
    VectorXd left = plain_.left;
    std::vector<NamedReading> steps;
    for (int step = 0; step < model_.joints(); ++step) {
      auto best = best_of(turned_signs(reading, judged_));
      if (!best || best->second.left.squaredNorm() > 0.9 * left.squaredNorm()) break;
      left = best->second.left;
      reading = best->first.reading;
      steps.push_back(std::move(best->first));
    }
    if (steps.empty() || !far_better(plain_.left, left, kFarBetter)) return false;
    for (const NamedReading& step : steps) {
      refuse(step.kind, step.joint,
             fmt::format("{} ({}); {}", step.what, left_words(left), step.cure));
    }
    return true;
  }

  bool many_turns(double farthest) {
    if (farthest < kManyTurns) return false;
    refuse("motor_side", 0,
           fmt::format("positions of a revolute joint span {:.4g} rad, and the model leaves {:.2g} "
                       "% of a joint's torque: degrees, encoder counts, or the motor's side of a "
                       "gear? give rad at the joint",
                       farthest, 100 * plain_.left.maxCoeff()));
    return true;
  }

  /// @param any  all directions, not only the opposite one
  bool other_gravity(bool any) {
    if (!robot_.with_gravity) return false;
    const bool none = robot_.gravity.norm() == 0;
    std::optional<Eigen::Vector3d> best;
    VectorXd left = plain_.left;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        const Eigen::Vector3d gravity = sign * kStandardGravity * Eigen::Vector3d::Unit(axis);
        const bool opposite = (gravity + robot_.gravity).norm() < 0.1 * kStandardGravity;
        if ((gravity - robot_.gravity).norm() < 0.1 * kStandardGravity) continue;
        if (!any && !none && !opposite) continue;
        const std::shared_ptr<const LinearModel> model = robot_.with_gravity(gravity);
        const TrialFit fit = samples_.fit(*model, Reading::plain(model->joints()));
        if ((fit.inertia.array() < 0).any() || fit.left.squaredNorm() >= left.squaredNorm())
          continue;
        left = fit.left;
        best = gravity;
      }
    }
    if (!best || !far_better(plain_.left, left, kGravityBetter)) return false;
    const std::string rows =
        fmt::format("gx {:g}, gy {:g}, gz {:g}", (*best)[0], (*best)[1], (*best)[2]);
    refuse("gravity", 0,
           fmt::format("{}: with {} in the robot file {}",
                       none ? "the robot file has no gravity, and this robot has"
                            : "gravity seems to point elsewhere than the robot file says",
                       rows, left_words(left)));
    return true;
  }

  /// A first moment that no arm of this reach has.
  void torque_unit() {
    if (!(robot_.reach > 0)) return;
    const double most = kNoArm * kArmDensity * std::pow(robot_.reach, 4);
    for (int c = 0; c < model_.size(); ++c) {
      const LinearParameter& parameter = model_.parameters[static_cast<std::size_t>(c)];
      if (parameter.kind != ParameterKind::kInertial || parameter.unit != "kg m") continue;
      const double value = std::abs(plain_.estimate.beta[c]);
      if (value < most || value < 10 * deviations_[c]) continue;
      refuse("torque_unit", parameter.link,
             fmt::format("{} comes out as {:.3g} kg m on an arm of {:.2g} m: is torque in N mm, or "
                         "in the motor's counts? give N m at the joint",
                         parameter.name, value, robot_.reach));
      return;
    }
  }

  /// A parameter that is no sum of others, negative where no body and no bearing has it so.
  [[nodiscard]] std::optional<int> negative_parameter() const {
    for (int c = 0; c < model_.size(); ++c) {
      const LinearParameter& parameter = model_.parameters[static_cast<std::size_t>(c)];
      const std::string& name = parameter.name;
      const bool own = parameter.formula == name || parameter.kind != ParameterKind::kInertial;
      const bool positive = parameter.kind == ParameterKind::kInertial
                                ? name.starts_with("XX") || name.starts_with("YY") ||
                                      name.starts_with("ZZ") || parameter.unit == "kg"
                                : parameter.kind != ParameterKind::kOffset;
      if (own && positive && plain_.estimate.beta[c] < -kCertainlyNegative * deviations_[c])
        return c;
    }
    return std::nullopt;
  }

  void no_body(int place) {
    const LinearParameter& parameter = model_.parameters[static_cast<std::size_t>(place)];
    remarks_.push_back(
        {"negative", false, 0, "",
         fmt::format("{} comes out negative ({:.3g} {}), which nothing is: a sign, gravity, or "
                     "physics that the model leaves out?",
                     parameter.name, plain_.estimate.beta[place], parameter.unit)});
  }

  void lags() {
    const Index most = samples_.most_lag();
    if (most < 1) return;
    const Reading base = Reading::plain(model_.joints());
    std::optional<Index> torque_lag = best_lag([&](Index lag) {
      Reading reading = base;
      reading.torque_lag = lag;
      return reading;
    });
    if (torque_lag) {
      say_lag(0, "torque", *torque_lag);
      return;
    }
    for (int j = 0; j < model_.joints(); ++j) {
      const std::optional<Index> lag = best_lag([&](Index samples) {
        Reading reading = base;
        reading.position_lag[static_cast<std::size_t>(j)] = samples;
        return reading;
      });
      if (lag) say_lag(j + 1, fmt::format("q{}", j + 1), *lag);
    }
  }

  void say_lag(int joint, const std::string& what, Index lag) {
    remarks_.push_back(
        {"lag", false, joint, "",
         fmt::format("{} {} by some {:.2g} ms: shift the column, or parameters are off", what,
                     lag > 0 ? "comes late" : "comes early",
                     1e3 * samples_.sample_time() * static_cast<double>(std::abs(lag)))});
  }

  template <class MakeReading>
  [[nodiscard]] std::optional<Index> best_lag(const MakeReading& make) const {
    const Index most = samples_.most_lag();
    std::optional<Index> best;
    VectorXd left = plain_.left;
    // lags in growing steps
    for (Index lag = 1; lag <= most; lag += std::max<Index>(1, lag / 2)) {
      for (const Index signed_lag : {lag, -lag}) {
        const TrialFit fit = samples_.fit(model_, make(signed_lag));
        if (fit.left.squaredNorm() >= left.squaredNorm()) continue;
        left = fit.left;
        best = signed_lag;
      }
    }
    return best && far_better(plain_.left, left, kLagBetter) ? best : std::nullopt;
  }

  void much_is_left() {
    Index worst = 0;
    plain_.left.maxCoeff(&worst);
    remarks_.push_back(
        {"residual", false, static_cast<int>(worst) + 1, "",
         fmt::format("a plain fit leaves {:.0f} % of joint {}'s torque: look at its columns, units "
                     "and signs before its parameters are believed",
                     100 * plain_.left[worst], worst + 1)});
  }

  const JudgedRobot& robot_;
  const LinearModel& model_;
  const TrialSamples& samples_;
  std::vector<Remark>& remarks_;
  TrialFit plain_;
  VectorXd deviations_;       ///< (nb) of its parameters
  std::vector<bool> judged_;  ///< (n) joints that have equations
};

/// Largest span of a revolute joint's positions, rad.
double farthest_span(const LinearModel& model, const std::vector<MotionSource>& sources) {
  double farthest = 0;
  for (const MotionSource& source : sources) {
    if (!source.recorded) continue;
    for (Index j = 0; j < source.recorded->joints(); ++j) {
      if (!model.revolute[static_cast<std::size_t>(j)]) continue;
      const auto q = source.recorded->q.col(j);
      farthest = std::max(farthest, q.maxCoeff() - q.minCoeff());
    }
  }
  return farthest;
}

}  // namespace

void add_model_remarks(const JudgedRobot& robot, const std::vector<MotionSource>& sources,
                       std::vector<Remark>& remarks) {
  TrialSamples samples(sources, kLagTried);
  if (samples.empty()) samples = TrialSamples(sources, 0);  // runs too short for lags
  if (samples.empty()) return;
  ModelJudge(robot, samples, remarks).run(farthest_span(*robot.model, sources));
}

}  // namespace dyngen::runtime
