// SPDX-License-Identifier: MIT
// Time of one update of every recursive estimator.
//
//   bench_recursive [options of Google Benchmark]
//
// Arms of six joints and 52 parameters, of seven and 62: the UR10e and the Panda of the tests,
// whose regressors are zero where a parameter cannot act on a joint, and regressors without zeros
// ("dense"), the worst there is.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include "bench_recursive_panda.h"
#include "bench_recursive_ur10e.h"
#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"
#include "runtime/recursive/minimum_variance.h"
#include "runtime/recursive/rls.h"

namespace dyngen::bench {
namespace {

constexpr Eigen::Index kSamples = 512;

struct Case {
  std::string name;
  int joints;
  runtime::RowMajorMatrix W;  // kSamples * joints rows
  Eigen::VectorXd tau;
};

Eigen::VectorXd normal_vector(std::mt19937_64& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(size);
  for (double& value : values) value = normal(random);
  return values;
}

using Regressor =
    std::function<void(const double* q, const double* dq, const double* ddq, double* Y)>;

/// Of an arm at random states, or dense if there is no arm.
Case make_case(std::string name, int joints, int parameters, const Regressor& regressor) {
  std::mt19937_64 random(20260301);
  Case result{std::move(name), joints, {}, {}};
  result.W.resize(kSamples * joints, parameters);
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    const Eigen::VectorXd q = normal_vector(random, joints), dq = normal_vector(random, joints),
                          ddq = normal_vector(random, joints);
    double* Y = result.W.row(k * joints).data();
    if (regressor) {
      regressor(q.data(), dq.data(), ddq.data(), Y);
    } else {
      Eigen::Map<Eigen::VectorXd>(Y, joints * parameters) =
          normal_vector(random, joints * parameters);
    }
  }
  result.tau =
      result.W * normal_vector(random, parameters) + 0.1 * normal_vector(random, kSamples * joints);
  return result;
}

template <typename Estimator>
void time_updates(benchmark::State& state, const Case& data, Estimator estimator) {
  Eigen::Index k = 0;
  for (auto _ : state) {
    const bool used =
        estimator.update(data.W.row(k * data.joints).data(), data.tau.data() + k * data.joints);
    if (!used) state.SkipWithError("an update was refused");
    k = (k + 1) % kSamples;
  }
  benchmark::DoNotOptimize(estimator.beta().data());
}

template <typename Estimator>
void add(const Case& data, const std::string& name, const Estimator& estimator) {
  benchmark::RegisterBenchmark(
      (data.name + "/" + name).c_str(),
      [&data, estimator](benchmark::State& state) { time_updates(state, data, estimator); });
}

void add_benchmarks(const Case& data) {
  const int n = data.joints, nb = static_cast<int>(data.W.cols());
  const Eigen::VectorXd gain =
      runtime::propose_gain(runtime::regressor_correlation(data.W, n), 0.01);
  add(data, "lms", runtime::Lms(n, {.gain = gain}));
  add(data, "lms_normalised", runtime::Lms(n, {.gain = gain, .normalised = true}));
  add(data, "convergent_mode_lms", runtime::ConvergentModeLms(n, {.gain = gain}));
  runtime::RlsOptions rls;
  rls.prior_covariance = 100 * Eigen::MatrixXd::Identity(nb, nb);
  add(data, "rls", runtime::Rls(n, nb, rls));
  rls.forgetting = 0.9999;
  rls.max_stddev = Eigen::VectorXd::Constant(nb, 10);
  add(data, "rls_forgetting_bounded", runtime::Rls(n, nb, rls));
  runtime::MinimumVarianceOptions filter;
  filter.prior_covariance = rls.prior_covariance;
  filter.measurement_covariance = 0.01 * Eigen::MatrixXd::Identity(n, n);
  add(data, "minimum_variance", runtime::MinimumVariance(filter));
  filter.walk_covariance = 1e-8 * Eigen::MatrixXd::Identity(nb, nb);
  add(data, "minimum_variance_walk", runtime::MinimumVariance(filter));
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  using dyngen::bench::Case;
  using dyngen::bench::make_case;
  const Case cases[] = {
      make_case("ur10e_6x52", BENCH_RECURSIVE_UR10E_NQ, BENCH_RECURSIVE_UR10E_NBETA,
                bench_recursive_ur10e_base_regressor),
      make_case("panda_7x62", BENCH_RECURSIVE_PANDA_NQ, BENCH_RECURSIVE_PANDA_NBETA,
                bench_recursive_panda_base_regressor),
      make_case("dense_6x52", 6, 52, nullptr),
      make_case("dense_7x62", 7, 62, nullptr),
  };
  for (const Case& data : cases) dyngen::bench::add_benchmarks(data);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
