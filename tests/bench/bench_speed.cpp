// SPDX-License-Identifier: MIT
// Speed of the emitted code beside Orocos KDL and MuJoCo: one process, the same random states.
//
//   bench_speed [--markdown] [options of Google Benchmark]
//
// Before anything is timed, all must give the same torques; exit code 1 if they do not.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/bench/speed_report.h"
#include "tests/bench/speed_robots.h"
#include "tests/support/relative_error.h"

namespace dyngen::bench {
namespace {

// The peers' own rounding is far below it; MuJoCo normalises quaternions.
constexpr double kAgreement = 1e-6;

/// A robot with its states and the peers that are there.
struct Contest {
  SpeedRobot robot;
  States states;
  std::vector<std::pair<std::string, Peer>> peers;
  std::vector<double> joint_major_q, joint_major_dq, joint_major_ddq, joint_major_tau;
};

std::vector<double> joint_major(const std::vector<double>& values, std::size_t joints) {
  std::vector<double> result(values.size());
  for (std::size_t k = 0; k < kStates; ++k) {
    for (std::size_t j = 0; j < joints; ++j) result[j * kStates + k] = values[k * joints + j];
  }
  return result;
}

Contest make_contest(SpeedRobot robot) {
  Contest contest;
  const std::size_t joints = robot.oracle.robot.size();
  contest.states = random_states(joints);
  contest.joint_major_q = joint_major(contest.states.q, joints);
  contest.joint_major_dq = joint_major(contest.states.dq, joints);
  contest.joint_major_ddq = joint_major(contest.states.ddq, joints);
  contest.joint_major_tau.resize(kStates * joints);
#ifdef DYNGEN_BENCH_KDL
  contest.peers.emplace_back("kdl", make_kdl_peer(robot.oracle.robot, contest.states));
#endif
#ifdef DYNGEN_BENCH_MUJOCO
  contest.peers.emplace_back("mujoco", make_mujoco_peer(robot.oracle.robot, contest.states));
#endif
  contest.robot = std::move(robot);
  return contest;
}

StateCall id_call(const Compiled& code, const States& states) {
  return [id = code.id, &states](std::size_t k, double* tau) {
    const std::size_t at = k * states.joints;
    id(&states.q[at], &states.dq[at], &states.ddq[at], tau);
  };
}

StateCall gravity_call(const Compiled& code, const States& states) {
  return [gravity = code.gravity, &states](std::size_t k, double* tau) {
    gravity(&states.q[k * states.joints], tau);
  };
}

std::vector<double> all_torques(const StateCall& call, std::size_t joints) {
  std::vector<double> tau(kStates * joints);
  for (std::size_t k = 0; k < kStates; ++k) call(k, &tau[k * joints]);
  return tau;
}

void evaluate_all(Contest& contest) {
  evaluate(contest.robot.id, kStates,
           {{"q", contest.joint_major_q},
            {"dq", contest.joint_major_dq},
            {"ddq", contest.joint_major_ddq}},
           {{"tau", contest.joint_major_tau}});
}

/// The emitted torque without rotor inertia and friction, which the peers do not have.
std::vector<double> rigid_part(const Contest& contest, std::vector<double> tau) {
  const std::size_t joints = contest.states.joints;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const test::NumericJoint& joint = contest.robot.oracle.robot.joints[i % joints];
    const double dq = contest.states.dq[i];
    tau[i] -= joint.IA * contest.states.ddq[i] + joint.Fv * dq +
              joint.Fs * static_cast<double>((dq > 0) - (dq < 0)) + joint.off;
  }
  return tau;
}

bool agree(const std::string& what, const std::vector<double>& actual,
           const std::vector<double>& expected) {
  const double error = test::relative_error(actual, expected);
  fmt::print("{:<34} differs by {:.1e} of the largest torque\n", what, error);
  return error < kAgreement;
}

bool verify(Contest& contest) {
  const std::size_t joints = contest.states.joints;
  const SpeedRobot& robot = contest.robot;
  const auto tau = all_torques(id_call(robot.plain, contest.states), joints);
  const auto gravity = all_torques(gravity_call(robot.plain, contest.states), joints);
  const std::vector<double> rigid = rigid_part(contest, tau);

  std::vector<double> stored, computed;
  for (const test::OracleState& state : robot.oracle.states) {
    std::vector<double> own(joints);
    robot.plain.id(state.q.data(), state.dq.data(), state.ddq.data(), own.data());
    stored.insert(stored.end(), state.tau.begin(), state.tau.end());
    computed.insert(computed.end(), own.begin(), own.end());
  }
  bool good = agree(robot.name + " id, stored", computed, stored);
  good &= agree(robot.name + " id, native",
                all_torques(id_call(robot.native, contest.states), joints), tau);
  evaluate_all(contest);
  good &= agree(robot.name + " id, evaluate", contest.joint_major_tau, joint_major(tau, joints));
  for (const auto& [name, peer] : contest.peers) {
    good &= agree(fmt::format("{} id, {}", robot.name, name), all_torques(peer.id, joints), rigid);
    if (!peer.gravity) continue;
    good &= agree(fmt::format("{} gravity, {}", robot.name, name),
                  all_torques(peer.gravity, joints), gravity);
  }
  return good;
}

/// As many calls of sin and cos as the emitted inverse dynamics makes, and nothing else: what part
/// of its time is the C library's.
StateCall sin_cos_call(const SpeedRobot& robot, const States& states) {
  const auto& instructions = robot.id.instructions;
  const auto pairs = static_cast<std::size_t>(std::count_if(
      instructions.begin(), instructions.end(),
      [](const Instruction& instruction) { return instruction.op == Instruction::Op::kSin; }));
  return [pairs, &states](std::size_t k, double* tau) {
    const double* q = &states.q[k * states.joints];
    for (std::size_t i = 0; i < pairs; ++i) {
      const std::size_t j = i < states.joints ? i : 0;
      tau[j] = std::sin(q[j]) - std::cos(q[j]);
    }
  };
}

/// One iteration of a benchmark is a sweep over all states.
void add_sweep(const std::string& name, StateCall call, std::size_t joints) {
  benchmark::RegisterBenchmark(
      name.c_str(), [call = std::move(call), joints](benchmark::State& state) {
        std::vector<double> tau(joints);
        for (auto _ : state) {
          for (std::size_t k = 0; k < kStates; ++k) {
            call(k, tau.data());
            benchmark::DoNotOptimize(tau.data());
            benchmark::ClobberMemory();
          }
        }
        state.SetItemsProcessed(static_cast<std::int64_t>(kStates) * state.iterations());
      });
}

void add_benchmarks(Contest& contest) {
  const std::string& robot = contest.robot.name;
  const std::size_t joints = contest.states.joints;
  const auto add = [&](const char* function, const std::string& who, StateCall call) {
    add_sweep(benchmark_name(robot, function, who), std::move(call), joints);
  };
  for (const auto& [who, code] : {std::pair{"dyngen_O2", &contest.robot.plain},
                                  std::pair{"dyngen_native", &contest.robot.native}}) {
    add("id", who, id_call(*code, contest.states));
    add("gravity", who, gravity_call(*code, contest.states));
  }
  add("id", "sin_cos", sin_cos_call(contest.robot, contest.states));
  for (const auto& [name, peer] : contest.peers) {
    add("id", name, peer.id);
    if (peer.gravity) add("gravity", name, peer.gravity);
  }
  benchmark::RegisterBenchmark(benchmark_name(robot, "id", "evaluate").c_str(),
                               [&contest](benchmark::State& state) {
                                 for (auto _ : state) evaluate_all(contest);
                               });
}

int run(bool markdown) {
  std::list<Contest> contests;  // benchmarks keep references
  std::vector<std::string> names;
  bool good = true;
  for (SpeedRobot& robot : speed_robots()) {
    names.push_back(robot.name);
    contests.push_back(make_contest(std::move(robot)));
    good &= verify(contests.back());
  }
  if (!good) {
    fmt::print(stderr, "bench_speed: torques differ by more than {}: nothing is timed\n",
               kAgreement);
    return 1;
  }
  for (Contest& contest : contests) add_benchmarks(contest);
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const Table table = speed_table(reporter, names);
  fmt::print("\nMedians of CPU time in ns per call over {} random states\n\n{}", kStates,
             markdown ? table.markdown() : table.text());
  return 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  // Nine repetitions in random order, unless the command line says otherwise: a disturbance of the
  // machine then meets all alike.
  std::vector<std::string> arguments = {argv[0], "--benchmark_repetitions=9",
                                        "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_min_time=0.05"};
  bool markdown = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--markdown") {
      markdown = true;
    } else {
      arguments.emplace_back(argv[i]);
    }
  }
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  try {
    return dyngen::bench::run(markdown);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
