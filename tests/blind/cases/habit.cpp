// SPDX-License-Identifier: MIT
#include "tests/blind/cases/habit.h"

#include <algorithm>
#include <stdexcept>

namespace blind {
namespace {

constexpr Range kCoarseBits = {12, 14};
constexpr Range kLoopDisturbance = {0.01, 0.05};  // over the rms of the torque
constexpr Range kLoopMemory = {0.05, 1};          // s

Habit plain_habit(const std::string& name, int periods = 5) {
  Habit habit;
  habit.name = name;
  habit.periods = periods;
  return habit;
}

Habit moving_habit(const std::string& name, Path path, Range length, std::array<Path, 2> heldout) {
  Habit habit = plain_habit(name);
  habit.path = path;
  habit.length = length;
  habit.heldout = heldout;
  return habit;
}

std::vector<Habit> habits_of_motion() {
  const std::array<Path, 2> free = {Path::kPoints, Path::kTeleoperation};
  const std::array<Path, 2> usual = {Path::kFourier, Path::kPoints};
  Habit teaching = moving_habit("teaching", Path::kTeaching, {30, 60}, free);
  teaching.rates = {100, 125};
  Habit sweeps = moving_habit("sweeps", Path::kSweeps, {20, 40}, usual);
  sweeps.rates = {100, 125, 200};
  Habit ramped = moving_habit("ramped", Path::kRamped, {25, 40}, free);
  ramped.periods = 4;
  return {
      moving_habit("points", Path::kPoints, {20, 40}, {Path::kSpeedSteps, Path::kTeleoperation}),
      teaching,
      moving_habit("teleoperation", Path::kTeleoperation, {20, 60}, usual),
      moving_habit("chirps", Path::kChirps, {15, 30}, free),
      moving_habit("speed_steps", Path::kSpeedSteps, {20, 40}, usual),
      sweeps,
      ramped};
}

std::vector<Habit> habits_of_length() {
  Habit one = plain_habit("one_file");
  one.files = 1;
  one.length = {30, 60};
  Habit many = plain_habit("many_files", 2);
  many.files = 8;
  many.length = {4, 8};
  Habit slow = plain_habit("slow_logger");
  slow.files = 2;
  slow.periods = 10;
  slow.length = {60, 300};
  slow.rates = {60, 75, 80, 100};
  slow.heldout = {Path::kPoints, Path::kSpeedSteps};
  Habit fast = plain_habit("fast_logger", 2);
  fast.length = {2, 6};
  fast.rates = {1000, 1250, 1600, 2000};
  return {one, many, slow, fast};
}

std::vector<Habit> habits_of_instruments() {
  Habit coarse = plain_habit("coarse_encoder");
  coarse.bits = kCoarseBits;
  Habit jittered = plain_habit("jittered");
  jittered.rates = {100, 125, 200, 250};
  jittered.jitter = {0.1, 0.3};
  jittered.stamp_digit = 1e-3;
  Habit late = plain_habit("late_columns");
  late.late = {1, 3};
  late.allowed = {"time_delay", "actuator_lag"};
  Habit current = plain_habit("current");
  current.gain_error = 0.05;
  current.colour = Colour::kPink;
  current.allowed = {"torque_gain"};
  Habit disturbed = plain_habit("loop_disturbance");
  disturbed.disturbance = kLoopDisturbance;
  disturbed.memory = kLoopMemory;
  Habit own = plain_habit("own_compensation");
  own.compensation_error = {0.1, 0.3};
  own.allowed = {"stribeck", "presliding", "nonlinear_viscous", "quadratic_drag"};
  return {coarse, jittered, late, current, disturbed, own};
}

/// Motions without periods in which a disturbance acts inside the loop, or encoders are coarse:
/// the motion that would be an instrument is not known.
std::vector<Habit> habits_without_instrument() {
  std::vector<Habit> all;
  for (const Habit& moving : habits_of_motion()) {
    if (moving.path != Path::kPoints && moving.path != Path::kTeleoperation) continue;
    Habit disturbed = moving, coarse = moving;
    disturbed.name = "loop_" + moving.name;
    disturbed.disturbance = kLoopDisturbance;
    disturbed.memory = kLoopMemory;
    coarse.name = "coarse_" + moving.name;
    coarse.bits = kCoarseBits;
    all.push_back(disturbed);
    all.push_back(coarse);
  }
  return all;
}

}  // namespace

const std::vector<Habit>& habits() {
  static const std::vector<Habit> all = [] {
    std::vector<Habit> some = {plain_habit("laboratory"), plain_habit("one_period", 1),
                               plain_habit("two_periods", 2), plain_habit("three_periods", 3),
                               plain_habit("ten_periods", 10)};
    for (const auto& more : {habits_of_length(), habits_of_motion(), habits_of_instruments(),
                             habits_without_instrument()}) {
      some.insert(some.end(), more.begin(), more.end());
    }
    return some;
  }();
  return all;
}

const Habit& habit_of(const std::string& name) {
  const std::vector<Habit>& all = habits();
  if (name.empty()) return all.front();
  const auto place =
      std::find_if(all.begin(), all.end(), [&](const Habit& each) { return each.name == name; });
  if (place != all.end()) return *place;
  std::string text = "habit '" + name + "': there are";
  for (const Habit& each : all) text += " " + each.name;
  throw std::invalid_argument(text);
}

Motion motion_along(const Way& way, const Arm& arm, Random random) {
  switch (way.path) {
    case Path::kFourier:
      return fourier_motion(arm, way.length, random, way.harmonics);
    case Path::kPoints:
      return point_to_point(arm, way.length, random);
    case Path::kTeaching:
      return point_to_point(arm, way.length, random, {0.2, 0.5, 2});
    case Path::kTeleoperation:
      return irregular_motion(arm, way.length, random);
    case Path::kChirps:
      return chirps(arm, way.length, random);
    case Path::kSpeedSteps:
      return speed_steps(arm, way.length, random);
    case Path::kSweeps:
      return single_joint_sweeps(arm, way.length, random);
    case Path::kRamped:
      return ramped_motion(arm, way.length, way.periods, random);
  }
  throw std::invalid_argument("motion_along(): no such path");
}

}  // namespace blind
