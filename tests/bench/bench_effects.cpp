// SPDX-License-Identifier: MIT
// What effects cost: inverse dynamics of the Panda with random numbers, plain, with Stribeck
// friction and with LuGre friction on all joints, one sample after the other and in batches.
//
//   bench_effects [options of Google Benchmark]
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <list>
#include <string>
#include <vector>

#include "tests/support/model_bridge.h"
#include "tests/support/shared_object.h"

namespace dyngen::bench {
namespace {

constexpr int kStates = 256;
constexpr int kJoints = 7;
constexpr std::uint64_t kSeed = 7;

/// The Panda with a row `effect` for each joint. @param row  {} is the joint
RobotModel panda_with(const std::string& row) {
  RobotModel model = test::with_random_values(test::read_model("robots/panda.robot"), kSeed);
  std::string text = "number_link 7\ngz 9.81\n";
  for (int joint = 1; joint <= kJoints && !row.empty(); ++joint) {
    text += fmt::format(fmt::runtime(row), joint) + "\n";
  }
  model.effects = test::parse_model(text + "m 1 1 1 1 1 1 1\nZZ 1 1 1 1 1 1 1\nstop\n").effects;
  return model;
}

/// The emitted code, compiled as dyngen_add_robot does.
class Compiled {
 public:
  Compiled(const std::string& row, bool state) : Compiled(emitted(row, state)) { state_ = state; }

  [[nodiscard]] void* symbol(const std::string& name) const { return library_.symbol(name); }
  [[nodiscard]] bool state() const { return state_; }

 private:
  explicit Compiled(const CText& text)
      : library_({{"panda.h", text.header}, {"panda.c", text.source}},
                 "-std=c99 -O2 -fno-tree-slp-vectorize") {}

  static CText emitted(const std::string& row, bool state) {
    GeneratorOptions options;
    options.functions = {"id"};
    if (!state) options.functions.emplace_back("id_batch");
    options.prefix = "panda";
    return generate(panda_with(row), options);
  }

  test::SharedObject library_;
  bool state_ = false;
};

/// Positions, velocities and accelerations of all states, one state after the other.
struct States {
  std::vector<double> q, dq, ddq;

  States() {
    for (const test::MotionSample& sample : test::random_samples(kJoints, kStates, kSeed)) {
      q.insert(q.end(), sample.q.begin(), sample.q.end());
      dq.insert(dq.end(), sample.dq.begin(), sample.dq.end());
      ddq.insert(ddq.end(), sample.ddq.begin(), sample.ddq.end());
    }
  }
};

void time_id(benchmark::State& run, const Compiled& code) {
  using Plain = void (*)(const double*, const double*, const double*, double*);
  using Stateful = void (*)(void*, const double*, const double*, const double*, double*);
  using Reset = void (*)(void*, double);
  void* const id = code.symbol("panda_id");
  std::vector<double> memory(64);
  if (code.state()) reinterpret_cast<Reset>(code.symbol("panda_reset"))(memory.data(), 1e-3);
  const States states;
  double tau[kJoints];
  for (auto _ : run) {
    for (std::size_t k = 0; k < kStates * kJoints; k += kJoints) {
      const double *q = &states.q[k], *dq = &states.dq[k], *ddq = &states.ddq[k];
      if (code.state()) {
        reinterpret_cast<Stateful>(id)(memory.data(), q, dq, ddq, tau);
      } else {
        reinterpret_cast<Plain>(id)(q, dq, ddq, tau);
      }
      benchmark::DoNotOptimize(tau[0]);
    }
  }
  run.counters["per call"] = benchmark::Counter(
      kStates, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void time_batch(benchmark::State& run, const Compiled& code) {
  using Batch = void (*)(std::size_t, const double*, const double*, const double*, double*);
  const auto id = reinterpret_cast<Batch>(code.symbol("panda_id_batch"));
  const States states;
  std::vector<double> tau(kStates * kJoints);
  for (auto _ : run) {
    id(kStates, states.q.data(), states.dq.data(), states.ddq.data(), tau.data());
    benchmark::DoNotOptimize(tau.data());
  }
  run.counters["per call"] = benchmark::Counter(
      kStates, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::list<Compiled> all;  // benchmarks keep references
  const auto add = [&](const std::string& name, const std::string& row, bool state) {
    const Compiled& code = all.emplace_back(row, state);
    benchmark::RegisterBenchmark(("id " + name).c_str(), time_id, std::cref(code));
    if (!state)
      benchmark::RegisterBenchmark(("id_batch " + name).c_str(), time_batch, std::cref(code));
  };
  add("plain", "", false);
  add("stribeck", "effect stribeck joint={} Fs=3 vs=0.05", false);
  add("load_friction", "effect load_friction joint={} mu=0.05", false);
  add("lugre", "effect lugre joint={} F=1 rise=1.3 vs=0.05 zs=0.002", true);
  fmt::print("Panda, {} random states (seed {}); 'per call' in s\n", kStates, kSeed);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) { return dyngen::bench::run(argc, argv); }
