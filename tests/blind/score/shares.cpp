// SPDX-License-Identifier: MIT
#include "tests/blind/score/shares.h"

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace blind {
namespace {

double threshold(int degrees, double level) {
  const boost::math::chi_squared_distribution<> null(degrees);
  return boost::math::quantile(boost::math::complement(null, level));
}

}  // namespace

Share share_of(int right, int of) {
  Share share{right, of, 0, 1};
  if (of == 0) return share;
  using Binomial = boost::math::binomial_distribution<>;
  const double n = of, k = right;
  if (right > 0) share.low = Binomial::find_lower_bound_on_p(n, k, 0.025);
  if (right < of) share.high = Binomial::find_upper_bound_on_p(n, k, 0.025);
  return share;
}

std::string text_of(const Share& share) {
  if (share.of == 0) return "none";
  return fmt::format("{} of {}, {:.1f} % ({:.1f} to {:.1f})", share.right, share.of,
                     100 * share.value(), 100 * share.low, 100 * share.high);
}

double oracle_power(double lambda, int degrees, double level) {
  if (lambda <= 0) return level;
  const boost::math::non_central_chi_squared_distribution<> there(degrees, lambda);
  return boost::math::cdf(boost::math::complement(there, threshold(degrees, level)));
}

double oracle_lambda(double power, int degrees) {
  const auto above = [&](double lambda) { return oracle_power(lambda, degrees) - power; };
  const boost::math::tools::eps_tolerance<double> fine(40);
  std::uintmax_t rounds = 200;
  const auto [low, high] =
      boost::math::tools::bracket_and_solve_root(above, 20.0, 2.0, true, fine, rounds);
  return (low + high) / 2;
}

double half_detected(const std::vector<std::pair<double, Share>>& steps) {
  struct Pool {
    double right, of;
    std::size_t count;
  };
  std::vector<Pool> pools;
  for (const auto& [lambda, share] : steps) {
    pools.push_back({static_cast<double>(share.right), static_cast<double>(share.of), 1});
    while (pools.size() > 1) {
      Pool& before = pools[pools.size() - 2];
      const Pool& last = pools.back();
      if (before.right * last.of <= last.right * before.of) break;
      before = {before.right + last.right, before.of + last.of, before.count + last.count};
      pools.pop_back();
    }
  }
  std::vector<double> rising;
  for (const Pool& pool : pools) rising.insert(rising.end(), pool.count, pool.right / pool.of);
  for (std::size_t i = 0; i + 1 < rising.size(); ++i) {
    if (rising[i] > 0.5 || rising[i + 1] < 0.5 || rising[i] == rising[i + 1]) continue;
    const double part = (0.5 - rising[i]) / (rising[i + 1] - rising[i]);
    return steps[i].first * std::pow(steps[i + 1].first / steps[i].first, part);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace blind
