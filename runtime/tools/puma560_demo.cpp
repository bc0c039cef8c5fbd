// SPDX-License-Identifier: MIT
//
// What the generated Puma 560 computes, and how fast: the numbers of the README.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "puma560.h"
#include "runtime/model/model_functions.h"

namespace {

using dyngen::runtime::ModelFunctions;
using Vector = Eigen::VectorXd;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kLabelWidth = 34;

Vector vector6(double a, double b, double c, double d, double e, double f) {
  Vector v(6);
  v << a, b, c, d, e, f;
  return v;
}

void print_row(const std::string& label, const Vector& tau) {
  fmt::print("  {:<{}}", label, kLabelWidth);
  for (const double value : tau) {
    const double rounded = std::round(value * 1000) / 1000;
    fmt::print("{:>12.3f}", rounded + 0.0);  // + 0.0 makes -0 a 0
  }
  fmt::print("\n");
}

void print_heading(const std::string& title, const ModelFunctions& robot) {
  fmt::print("\n{:<{}}", title, kLabelWidth + 2);
  for (const std::string& joint : robot.joint_names) fmt::print("{:>12}", joint);
  fmt::print("\n");
}

void print_gravity(const ModelFunctions& robot) {
  print_heading("Torque that holds the arm [N m]", robot);
  const struct {
    const char* name;
    Vector q;
  } postures[] = {
      {"upper arm level, forearm up", vector6(0, 0, 0, 0, 0, 0)},
      {"straight up", vector6(0, -90, 90, 0, 0, 0)},
      {"stretched out", vector6(0, 0, 90, 0, 0, 0)},
      {"stretched out, hand bent by 90 deg", vector6(0, 0, 90, 0, 90, 0)},
      {"elbow up, reaching down", vector6(30, -45, 180, 20, 45, 10)},
  };
  for (const auto& posture : postures) {
    print_row(posture.name, gravity(robot, posture.q * kDegree));
  }
}

void print_motion(const ModelFunctions& robot) {
  const Vector q = vector6(30, -45, 150, 20, 45, 10) * kDegree;
  const Vector dq = vector6(1, -0.8, 1.2, 2, -1.5, 2);
  const Vector ddq = vector6(3, 4, -5, 6, 6, -8);
  print_heading("A fast motion", robot);
  print_row("q [deg]", q / kDegree);
  print_row("dq [rad/s]", dq);
  print_row("ddq [rad/s^2]", ddq);
  const Vector tau = inverse_dynamics(robot, q, dq, ddq);
  const Vector weight = gravity(robot, q);
  const Vector centrifugal = coriolis(robot, q, dq);
  const Vector drag = friction(robot, dq);
  print_row("gravity [N m]", weight);
  print_row("Coriolis and centrifugal [N m]", centrifugal);
  print_row("friction [N m]", drag);
  print_row("inertia: the rest [N m]", tau - weight - centrifugal - drag);
  print_row("inverse dynamics: the sum [N m]", tau);
}

/// Random states, one after the other: q, dq, ddq of each.
std::vector<double> random_states(int count, int nq) {
  std::mt19937_64 random(560);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  std::vector<double> states(static_cast<std::size_t>(count * 3 * nq));
  std::generate(states.begin(), states.end(), [&] { return angle(random); });
  return states;
}

/// Median over the rounds of the mean time of a call.
double median_nanoseconds(const ModelFunctions& robot) {
  using Clock = std::chrono::steady_clock;
  constexpr int kStates = 4096, kRounds = 201;
  const std::vector<double> states = random_states(kStates, robot.nq);
  std::vector<double> tau(static_cast<std::size_t>(robot.nq));
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = Clock::now();
    for (int k = 0; k < kStates; ++k) {
      const double* q = states.data() + k * 3 * robot.nq;
      robot.id(q, q + robot.nq, q + 2 * robot.nq, tau.data());
    }
    const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
    times.push_back(spent.count() / kStates);
  }
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  return times[kRounds / 2];
}

}  // namespace

int main() {
  const ModelFunctions robot{
      "puma560",       PUMA560_NQ,      {puma560_joint_names, puma560_joint_names + PUMA560_NQ},
      puma560_id,      puma560_gravity, puma560_coriolis,
      puma560_friction};
  robot.validate();
  print_gravity(robot);
  print_motion(robot);
  const double time = median_nanoseconds(robot);
  fmt::print(
      "\nSpeed: inverse dynamics of all {} joints takes {:.0f} ns, {:.1f} million calls a second "
      "on one "
      "core\n       (median of 201 rounds over 4096 random states).\n",
      robot.nq, time, 1e3 / time);
}
