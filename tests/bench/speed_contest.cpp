// SPDX-License-Identifier: MIT
#include "tests/bench/speed_contest.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/bench/speed_report.h"

namespace dyngen::bench {
namespace {

test::NumericRobot without_drives(test::NumericRobot robot) {
  for (test::NumericJoint& joint : robot.joints) joint.IA = joint.Fs = joint.Fv = joint.off = 0;
  return robot;
}

/// As many calls of sin and cos as the emitted inverse dynamics makes, and nothing else: what part
/// of its time would be the C library's.
std::function<void(double*)> sin_cos_sweep(const Contest& contest) {
  const auto& instructions = contest.robot.id.instructions;
  const auto pairs = static_cast<std::size_t>(std::count_if(
      instructions.begin(), instructions.end(),
      [](const Instruction& instruction) { return instruction.op == Instruction::Op::kSin; }));
  return [pairs, &contest](double* tau) {
    const std::size_t joints = contest.states.joints;
    for (std::size_t k = 0; k < kStates; ++k) {
      const double* const q = contest.states.sample(k).q;
      for (std::size_t i = 0; i < pairs; ++i) {
        const std::size_t j = i < joints ? i : 0;
        tau[j] = std::sin(q[j]) - std::cos(q[j]);
      }
      benchmark::ClobberMemory();
    }
  };
}

/// One iteration computes `samples` samples.
template <typename Call>
void add(const std::string& name, std::size_t samples, Call call) {
  benchmark::RegisterBenchmark(
      name.c_str(), [call = std::move(call), samples](benchmark::State& state) mutable {
        for (auto _ : state) {
          call();
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(static_cast<std::int64_t>(samples) * state.iterations());
      });
}

void add_emitted(const Contest& contest, const Emitted& emitted, const std::string& who) {
  const std::size_t joints = contest.states.joints;
  const auto name = [&](const std::string& function) {
    return benchmark_name(contest.robot.name, function, who);
  };
  const std::size_t largest = joints * std::max(3 * joints, emitted.chi.size());
  for (const auto& [function, sweep] : emitted.sweeps) {
    add(name(function), kStates,
        [&states = contest.states, call = sweep, out = std::vector<double>(largest)]() mutable {
          call(states, kStates, out.data(), 0);
        });
  }
  add(name("id_batch"), kBatch,
      [&contest, call = emitted.id_batch, tau = std::vector<double>(kBatch * joints)]() mutable {
        call(contest.batch, tau.data());
      });
  add(name("id_batch float"), kBatch,
      [&contest, call = emitted.id_batch_float,
       tau = std::vector<float>(kBatch * joints)]() mutable {
        call(contest.batch_float, tau.data());
      });
}

}  // namespace

Contest::Contest(SpeedRobot contested)
    : robot(std::move(contested)),
      rigid(without_drives(robot.numbers)),
      states(random_states(rigid.size())),
      batch(rows<double>(states)),
      batch_float(rows<float>(states)) {
#ifdef DYNGEN_BENCH_KDL
  peers.emplace_back("kdl", make_kdl_peer(rigid, states));
#endif
#ifdef DYNGEN_BENCH_MUJOCO
  peers.emplace_back("mujoco", make_mujoco_peer(rigid, states));
#endif
#ifdef DYNGEN_BENCH_DART
  peers.emplace_back("dart", make_dart_peer(rigid, states));
#endif
}

EvaluatedId::EvaluatedId(const Contest& contest)
    : program_(contest.robot.id),
      chi_(contest.robot.plain.chi),
      rows_(rows<double>(contest.states, kStates)),
      tau_(kStates * contest.states.joints) {}

const std::vector<double>& EvaluatedId::operator()() {
  evaluate(program_, kStates, {{"q", rows_.q}, {"dq", rows_.dq}, {"ddq", rows_.ddq}, {"chi", chi_}},
           {{"tau", tau_}});
  return tau_;
}

void add_benchmarks(const Contest& contest) {
  const std::string& robot = contest.robot.name;
  const std::size_t joints = contest.states.joints;
  add_emitted(contest, contest.robot.plain, "dyngen_O2");
  add_emitted(contest, contest.robot.native, "dyngen_native");
  add(benchmark_name(robot, "id", "sin_cos"), kStates,
      [call = sin_cos_sweep(contest), out = std::vector<double>(joints)]() mutable {
        call(out.data());
      });
  add(benchmark_name(robot, "id", "evaluate"), kStates,
      [evaluated = EvaluatedId(contest)]() mutable { evaluated(); });
  for (const auto& [who, peer] : contest.peers) {
    for (const auto& [function, call] : peer) {
      add(benchmark_name(robot, function, who), kStates,
          [call = call, out = std::vector<double>(joints * joints)]() mutable {
            for (std::size_t k = 0; k < kStates; ++k) call(k, out.data());
          });
    }
  }
}

}  // namespace dyngen::bench
