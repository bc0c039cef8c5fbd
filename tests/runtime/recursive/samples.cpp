// SPDX-License-Identifier: MIT
#include "tests/runtime/recursive/samples.h"

#include <cstdio>

#include "tests/support/oracle_data.h"

namespace dyngen::test {

Eigen::VectorXd normal_vector(std::mt19937_64& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(size);
  for (double& value : values) value = normal(random);
  return values;
}

Samples random_samples(unsigned seed, int joints, int parameters, int samples, double noise) {
  std::printf("seed %u\n", seed);
  std::mt19937_64 random(seed);
  Samples result{joints, {}, {}, normal_vector(random, parameters)};
  result.W.resize(static_cast<Eigen::Index>(samples) * joints, parameters);
  for (Eigen::Index row = 0; row < result.W.rows(); ++row) {
    result.W.row(row) = normal_vector(random, parameters).transpose();
  }
  result.tau = result.W * result.beta + noise * normal_vector(random, result.W.rows());
  return result;
}

Samples puma3_samples(unsigned seed, double noise) {
  std::printf("seed %u\n", seed);
  std::mt19937_64 random(seed);
  const Table table = load_puma3_regressor();
  const NamedValues values = load_table_7_1();
  const auto nb = static_cast<Eigen::Index>(values.values.size());
  Samples result{3, {}, {}, runtime::VectorMap(values.values.data(), nb)};
  result.W.resize(static_cast<Eigen::Index>(table.rows.size()) * 3, nb);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const std::vector<double> rows =
        table.slice(k, "Y1_" + values.names.front(), 3 * values.names.size());
    result.W.middleRows(static_cast<Eigen::Index>(k) * 3, 3) =
        runtime::RegressorMap(rows.data(), 3, nb);
  }
  result.tau = result.W * result.beta + noise * normal_vector(random, result.W.rows());
  return result;
}

double relative_distance(const Eigen::VectorXd& beta, const Eigen::VectorXd& truth) {
  return (beta - truth).norm() / truth.norm();
}

}  // namespace dyngen::test
