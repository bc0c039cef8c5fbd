// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/base_parameters/dependencies.h"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "gen/base_parameters/echelon.h"
#include "gen/base_parameters/interpolation.h"
#include "gen/base_parameters/numeric_regressor.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using cln::cl_R;

constexpr std::uint64_t kSeed = 20240611;
constexpr long double kRankTolerance = 1e-11L;    // of the column's norm
constexpr long double kSupportTolerance = 1e-8L;  // coefficients below are rounding

/// One draw of numbers for the unknown lengths.
GiNaC::exmap draw_lengths(const SymbolicRobot& robot, RandomStream& random) {
  GiNaC::exmap lengths;
  for (const FileSymbol& entry : robot.geometry) lengths[entry.symbol] = random.next();
  return lengths;
}

/// Columns of the regressor over enough random states, column by column.
std::vector<std::vector<long double>> sample_columns(const SymbolicRobot& robot,
                                                     const GiNaC::exmap& lengths,
                                                     const std::vector<Column>& columns,
                                                     Motions motions, RandomStream& random) {
  const auto geometry = numeric_geometry<long double>(robot, lengths);
  const std::size_t rows_wanted = columns.size() + columns.size() / 4 + 24;
  std::vector<std::vector<long double>> result(columns.size());
  for (std::size_t rows = 0; rows < rows_wanted;
       rows += static_cast<std::size_t>(robot.coordinate_count)) {
    const RandomState state = random_state(robot, random, motions == Motions::kAll);
    for (const auto& row : numeric_regressor(geometry, state, columns)) {
      for (std::size_t k = 0; k < columns.size(); ++k) result[k].push_back(row[k]);
    }
  }
  return result;
}

long double dot(const std::vector<long double>& a, const std::vector<long double>& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The columns that a dependent column is made of, by place; found by Gram-Schmidt, twice.
struct Candidate {
  std::size_t column;
  std::vector<std::size_t> support;
};

std::vector<Candidate> find_candidates(const std::vector<std::vector<long double>>& columns) {
  std::vector<Candidate> candidates;
  std::vector<std::vector<long double>> basis;       // orthonormal
  std::vector<std::vector<long double>> triangular;  // R, a column for each basis vector
  std::vector<std::size_t> places;
  long double largest = 0;
  for (const auto& column : columns) largest = std::max(largest, std::sqrt(dot(column, column)));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<long double> rest = columns[k];
    const long double norm = std::sqrt(dot(rest, rest));
    std::vector<long double> projection(basis.size(), 0.0L);
    for (int round = 0; round < 2 && norm > 0; ++round) {
      for (std::size_t b = 0; b < basis.size(); ++b) {
        const long double part = dot(basis[b], rest);
        projection[b] += part;
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= part * basis[b][i];
      }
    }
    const long double left = std::sqrt(dot(rest, rest));
    if (norm > kRankTolerance * largest && left > kRankTolerance * norm) {
      for (long double& value : rest) value /= left;
      projection.push_back(left);
      basis.push_back(std::move(rest));
      triangular.push_back(std::move(projection));
      places.push_back(k);
      continue;
    }
    Candidate candidate{k, {}};
    if (norm > kRankTolerance * largest) {  // R x = projection, backwards
      for (std::size_t b = basis.size(); b-- > 0;) {
        const long double x = projection[b] / triangular[b][b];
        for (std::size_t i = 0; i <= b; ++i) projection[i] -= x * triangular[b][i];
        const long double own = std::sqrt(dot(columns[places[b]], columns[places[b]]));
        if (std::abs(x) * own > kSupportTolerance * norm) candidate.support.push_back(places[b]);
      }
      std::reverse(candidate.support.begin(), candidate.support.end());
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

/// Solves rows * (x, -1) = 0 exactly enough; nothing if the rows contradict each other.
std::optional<std::vector<cl_R>> solve(std::vector<std::vector<cl_R>> rows, std::size_t unknowns) {
  for (std::size_t k = 0; k < unknowns; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < rows.size(); ++i) {
      if (cln::abs(rows[i][k]) > cln::abs(rows[pivot][k])) pivot = i;
    }
    if (cln::abs(rows[pivot][k]) < rounding_limit()) return std::nullopt;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == k) continue;
      const cl_R factor = rows[i][k] / rows[k][k];
      for (std::size_t c = k; c <= unknowns; ++c) rows[i][c] = rows[i][c] - factor * rows[k][c];
    }
  }
  for (std::size_t i = unknowns; i < rows.size(); ++i) {
    if (cln::abs(rows[i][unknowns]) > rounding_limit()) return std::nullopt;
  }
  std::vector<cl_R> x;
  for (std::size_t k = 0; k < unknowns; ++k) x.push_back(rows[k][unknowns] / rows[k][k]);
  return x;
}

/// Solves one candidate with many digits; nothing if it does not hold there.
std::optional<std::vector<cl_R>> refine(const SymbolicRobot& robot, const GiNaC::exmap& lengths,
                                        const std::vector<Column>& columns,
                                        const Candidate& candidate, Motions motions,
                                        RandomStream& random) {
  std::vector<Column> involved;
  for (const std::size_t k : candidate.support) involved.push_back(columns[k]);
  involved.push_back(columns[candidate.column]);
  const auto geometry = numeric_geometry<cl_R>(robot, lengths);
  std::vector<std::vector<cl_R>> rows;
  while (rows.size() < 2 * involved.size() + 8) {
    const RandomState state = random_state(robot, random, motions == Motions::kAll);
    for (auto& row : numeric_regressor(geometry, state, involved)) rows.push_back(std::move(row));
  }
  return solve(std::move(rows), candidate.support.size());
}

/// The coefficients of one candidate: numbers, or functions of the unknown lengths.
std::optional<std::vector<GiNaC::ex>> find_coefficients(const SymbolicRobot& robot,
                                                        const std::vector<Column>& columns,
                                                        const Candidate& candidate, Motions motions,
                                                        RandomStream& random) {
  std::vector<GiNaC::symbol> unknowns;
  for (const FileSymbol& entry : robot.geometry) unknowns.push_back(entry.symbol);
  const Sampler sampler = [&](const GiNaC::exmap& lengths) {
    return refine(robot, lengths, columns, candidate, motions, random);
  };
  return interpolate(sampler, unknowns, random);
}

}  // namespace

Dependencies find_dependencies(const SymbolicRobot& robot, const std::vector<Column>& columns,
                               Motions motions) {
  const PrecisionScope precision;
  RandomStream random(kSeed);
  const GiNaC::exmap lengths = draw_lengths(robot, random);
  const auto samples = sample_columns(robot, lengths, columns, motions, random);
  Dependencies result;
  for (const Candidate& candidate : find_candidates(samples)) {
    if (!refine(robot, lengths, columns, candidate, motions, random)) continue;
    const auto x = find_coefficients(robot, columns, candidate, motions, random);
    if (!x) {
      result.unsolved.push_back(columns[candidate.column]);
      continue;
    }
    Dependency dependency{columns[candidate.column], {}};
    for (std::size_t i = 0; i < x->size(); ++i) {
      dependency.others.emplace_back(columns[candidate.support[i]], (*x)[i]);
    }
    result.found.push_back(std::move(dependency));
  }
  return result;
}

}  // namespace dyngen
