// SPDX-License-Identifier: MIT
// Regressor and triangular factor of many samples of a seven-joint robot: dyngen's evaluated
// program beside regressors that KDL and DART build column by column from unit parameters.
//
//   bench_identification [options of Google Benchmark]
//
// The counter `million` is the time for a million samples on one core. All three feed the same
// factorisation with the same columns; their regressors are compared first.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/estimation/torque_factor.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/bench/peers.h"
#include "tests/support/model_bridge.h"

namespace dyngen::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kBlock = 1024;

struct Setup {
  runtime::DescribedRobot robot = runtime::describe_robot(
      DYNGEN_SOURCE_DIR "/tests/studies/robots/panda.robot", runtime::OpenParameters::kAsWritten);
  States states = random_states(static_cast<std::size_t>(robot.linear.joints()));
  MatrixXd q, dq, ddq, tau;

  Setup() {
    const auto matrix = [&](const std::vector<double>& values) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      return MatrixXd(Eigen::Map<const RowMajor>(values.data(), static_cast<Index>(kStates),
                                                 static_cast<Index>(states.joints)));
    };
    q = matrix(states.q);
    dq = matrix(states.dq);
    ddq = matrix(states.ddq);
    tau = matrix(states.tau);
  }
};

const Setup& setup() {
  static const Setup once;
  return once;
}

using MakePeer = Peer (*)(const test::NumericRobot&, const States&);

/// A regressor column by column: torque of a unit parameter of a link, and of nothing else.
///
/// A body needs a mass: the unit parameter is added to a link of 1 kg, whose own torque is taken
/// away again.
class UnitParameters {
 public:
  explicit UnitParameters(MakePeer make) : make_(make) {
    const runtime::DescribedRobot& robot = setup().robot;
    test::NumericRobot empty = test::numeric_robot(robot.model);
    for (test::NumericJoint& joint : empty.joints) {
      joint.inertial = {};
      joint.IA = joint.Fs = joint.Fv = joint.off = 0;
    }
    const std::size_t joints = empty.joints.size();
    for (std::size_t link = 0; link < joints; ++link) {
      test::NumericRobot mass = empty;
      mass.joints[link].inertial[9] = 1;
      masses_.push_back(make_(mass, setup().states).at("id"));
    }
    for (int i = 0; i < robot.linear.size(); ++i) {
      Column column{
          i,
          static_cast<std::size_t>(robot.linear.parameters[static_cast<std::size_t>(i)].link - 1),
          robot.linear.parameters[static_cast<std::size_t>(i)].kind,
          {}};
      if (column.kind == runtime::ParameterKind::kInertial) {
        const std::size_t kind =
            static_cast<std::size_t>(robot.places[static_cast<std::size_t>(i)]) % kChiCount;
        test::NumericRobot unit = empty;
        unit.joints[column.link].inertial[9] = 1;
        unit.joints[column.link].inertial[kind] += 1;
        column.call = make_(unit, setup().states).at("id");
      }
      columns_.push_back(std::move(column));
    }
  }

  void regressor(Index start, Index count, MatrixXd& Y) const {
    const Setup& s = setup();
    const Index n = s.q.cols(), nb = static_cast<Index>(columns_.size());
    Y.setZero(count, n * nb);
    std::vector<double> torque(static_cast<std::size_t>(n));
    MatrixXd masses(n, n);  // column: of the link
    for (Index k = 0; k < count; ++k) {
      const std::size_t state = static_cast<std::size_t>(start + k);
      for (Index link = 0; link < n; ++link) {
        masses_[static_cast<std::size_t>(link)](state, masses.col(link).data());
      }
      for (const Column& column : columns_) {
        const Index own = static_cast<Index>(column.link);
        switch (column.kind) {
          case runtime::ParameterKind::kInertial:
            column.call(state, torque.data());
            for (Index j = 0; j < n; ++j) {
              Y(k, j * nb + column.place) = torque[static_cast<std::size_t>(j)] - masses(j, own);
            }
            break;
          case runtime::ParameterKind::kRotorInertia:
            Y(k, own * nb + column.place) = s.ddq(start + k, own);
            break;
          case runtime::ParameterKind::kViscous:
            Y(k, own * nb + column.place) = s.dq(start + k, own);
            break;
          case runtime::ParameterKind::kCoulomb: {
            const double v = s.dq(start + k, own);
            Y(k, own * nb + column.place) = static_cast<double>((v > 0) - (v < 0));
            break;
          }
          case runtime::ParameterKind::kOffset:
            Y(k, own * nb + column.place) = 1;
            break;
        }
      }
    }
  }

 private:
  struct Column {
    int place;
    std::size_t link;
    runtime::ParameterKind kind;
    StateCall call;
  };
  MakePeer make_;
  std::vector<StateCall> masses_;
  std::vector<Column> columns_;
};

using MakeRegressor = std::function<void(Index start, Index count, MatrixXd& Y)>;

void dyngen_regressor(Index start, Index count, MatrixXd& Y) {
  const Setup& s = setup();
  s.robot.linear.regressor(s.q.middleRows(start, count), s.dq.middleRows(start, count),
                           s.ddq.middleRows(start, count), Y);
}

void run(benchmark::State& state, const MakeRegressor& make, bool factorise) {
  const Setup& s = setup();
  runtime::TorqueFactor factor =
      runtime::empty_factor(s.robot.linear.columns, s.robot.linear.size());
  MatrixXd Y;
  Index samples = 0;
  for (auto _ : state) {
    const Index start = samples % static_cast<Index>(kStates);
    make(start, kBlock, Y);
    if (factorise) runtime::absorb(factor, Y, s.tau.middleRows(start, kBlock));
    benchmark::DoNotOptimize(Y.data());
    samples += kBlock;
  }
  state.counters["million"] =
      benchmark::Counter(static_cast<double>(samples) / 1e6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

double largest_difference(const MakeRegressor& make) {
  MatrixXd ours, theirs;
  dyngen_regressor(0, 64, ours);
  make(0, 64, theirs);
  return (ours - theirs).cwiseAbs().maxCoeff() / ours.cwiseAbs().maxCoeff();
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  using namespace dyngen::bench;
  std::vector<std::pair<std::string, MakeRegressor>> contestants = {{"dyngen", dyngen_regressor}};
  const auto add_peer = [&](const char* name, MakePeer make) {
    auto peer = std::make_shared<UnitParameters>(make);
    const MakeRegressor regressor = [peer](auto start, auto count, auto& Y) {
      peer->regressor(start, count, Y);
    };
    const double difference = largest_difference(regressor);
    std::printf("%s: regressor differs by %.1e of the largest entry\n", name, difference);
    if (difference < 1e-9) contestants.emplace_back(name, regressor);
  };
#ifdef DYNGEN_BENCH_KDL
  add_peer("KDL", make_kdl_peer);
#endif
#ifdef DYNGEN_BENCH_DART
  add_peer("DART", make_dart_peer);
#endif
  for (const auto& [name, make] : contestants) {
    for (const bool factorise : {false, true}) {
      benchmark::RegisterBenchmark(
          (name + (factorise ? " regressor and QR" : " regressor")).c_str(),
          [make = make, factorise](benchmark::State& state) { run(state, make, factorise); })
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
