// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/base_parameters/interpolation.h"

#include <cln/float.h>
#include <cln/rational.h>

#include <algorithm>
#include <utility>

#include "gen/base_parameters/echelon.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using cln::cl_R;
using GiNaC::ex;

constexpr int kMostDegree = 4;
constexpr std::size_t kMostInterpolatedTerms =
    130;  // of one interpolation: as many points are drawn
constexpr std::size_t kFreshPoints = 3;

bool same(const cl_R& a, const cl_R& b) {
  return cln::abs(a - b) <
         cln::cl_RA("1/10000000000000000000000000000000000000000") * (cln::abs(a) + cln::cl_R(1));
}

/// One draw of the unknowns and what the numbers are there.
struct Point {
  std::vector<GiNaC::numeric> unknowns;
  std::vector<cl_R> values;
};

using Exponents = std::vector<int>;  // one for each unknown that matters

void add_monomials(std::size_t unknown, int degree, Exponents& exponents,
                   std::vector<Exponents>& result) {
  if (unknown == exponents.size()) {
    result.push_back(exponents);
    return;
  }
  for (int e = 0; e <= degree; ++e) {
    exponents[unknown] = e;
    add_monomials(unknown + 1, degree - e, exponents, result);
  }
  exponents[unknown] = 0;
}

std::vector<Exponents> monomials(std::size_t unknowns, int degree) {
  std::vector<Exponents> result;
  Exponents exponents(unknowns, 0);
  add_monomials(0, degree, exponents, result);
  return result;
}

/// Terms of Pascal's triangle: how many monomials there are.
std::size_t monomial_count(std::size_t unknowns, int degree) {
  std::size_t count = 1;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(degree); ++k) {
    count = count * (unknowns + k) / k;
  }
  return count;
}

class Interpolation {
 public:
  Interpolation(const Sampler& sampler, const std::vector<GiNaC::symbol>& unknowns,
                RandomStream& random)
      : sampler_(sampler), unknowns_(unknowns), random_(random) {}

  std::optional<std::vector<ex>> run() {
    if (!draw()) return std::nullopt;
    if (!find_relevant()) return std::nullopt;
    std::vector<ex> result;
    for (std::size_t component = 0; component < points_[0].values.size(); ++component) {
      const std::optional<ex> found = find(component);
      if (!found) return std::nullopt;
      result.push_back(*found);
    }
    return result;
  }

 private:
  std::optional<std::vector<cl_R>> sample(const std::vector<GiNaC::numeric>& numbers) const {
    GiNaC::exmap values;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) values[unknowns_[i]] = numbers[i];
    return sampler_(values);
  }

  /// One point more, all unknowns random.
  bool draw() {
    Point point;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) point.unknowns.push_back(random_.next());
    std::optional<std::vector<cl_R>> values = sample(point.unknowns);
    if (!values) return false;
    point.values = std::move(*values);
    points_.push_back(std::move(point));
    return true;
  }

  bool draw_until(std::size_t count) {
    while (points_.size() < count) {
      if (!draw()) return false;
    }
    return true;
  }

  /// relevant_[component]: places of the unknowns that it changes with.
  bool find_relevant() {
    relevant_.resize(points_[0].values.size());
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      std::vector<GiNaC::numeric> moved = points_[0].unknowns;
      moved[i] = random_.next();
      const auto values = sample(moved);
      if (!values) return false;
      for (std::size_t component = 0; component < relevant_.size(); ++component) {
        if (!same((*values)[component], points_[0].values[component])) {
          relevant_[component].push_back(i);
        }
      }
    }
    return true;
  }

  std::optional<ex> find(std::size_t component) {
    const std::size_t unknowns = relevant_[component].size();
    for (int degree = 0; degree <= kMostDegree; ++degree) {
      if (monomial_count(unknowns, degree) > kMostInterpolatedTerms) break;
      if (auto found = fit(component, degree)) return found;
      if (unknowns == 0) return std::nullopt;
    }
    return std::nullopt;
  }

  cl_R value_of(const Exponents& exponents, std::size_t component, const Point& point) const {
    cl_R value = 1;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      const cl_R unknown = cln::the<cl_R>(point.unknowns[relevant_[component][i]].to_cl_N());
      for (int e = 0; e < exponents[i]; ++e) value = value * unknown;
    }
    return value;
  }

  ex symbol_of(const Exponents& exponents, std::size_t component) const {
    ex product = 1;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      product *= GiNaC::pow(unknowns_[relevant_[component][i]], exponents[i]);
    }
    return product;
  }

  /// The polynomial of this degree through as many points as it has coefficients.
  std::optional<ex> fit(std::size_t component, int degree) {
    const auto terms = monomials(relevant_[component].size(), degree);
    if (!draw_until(terms.size() + kFreshPoints)) return std::nullopt;
    NumberMatrix rows;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      std::vector<cl_R> row;
      for (const Exponents& term : terms) row.push_back(value_of(term, component, points_[i]));
      row.push_back(points_[i].values[component]);
      rows.push_back(std::move(row));
    }
    const Echelon solved = echelon(std::move(rows), terms.size());
    if (solved.rank() != terms.size()) return std::nullopt;
    ex result = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const ex coefficient = settle_number(GiNaC::numeric(solved.rows[i].back()));
      result += coefficient * symbol_of(terms[i], component);
    }
    return holds(result, component, terms.size()) ? std::optional<ex>(result) : std::nullopt;
  }

  /// At the points that were not used to find it.
  bool holds(const ex& result, std::size_t component, std::size_t first) const {
    for (std::size_t i = first; i < points_.size(); ++i) {
      GiNaC::exmap values;
      for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        values[unknowns_[k]] = points_[i].unknowns[k];
      }
      const ex number = result.subs(values).evalf();
      if (!GiNaC::is_a<GiNaC::numeric>(number)) return false;
      const cl_R value = cln::the<cl_R>(GiNaC::ex_to<GiNaC::numeric>(number).to_cl_N());
      if (!same(value, points_[i].values[component])) return false;
    }
    return true;
  }

  const Sampler& sampler_;
  const std::vector<GiNaC::symbol>& unknowns_;
  RandomStream& random_;
  std::vector<Point> points_;
  std::vector<std::vector<std::size_t>> relevant_;
};

}  // namespace

std::optional<std::vector<ex>> interpolate(const Sampler& sampler,
                                           const std::vector<GiNaC::symbol>& unknowns,
                                           RandomStream& random) {
  const PrecisionScope precision;
  return Interpolation(sampler, unknowns, random).run();
}

}  // namespace dyngen
