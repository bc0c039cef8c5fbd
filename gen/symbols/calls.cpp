// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symbols/calls.h"

#include <cln/exception.h>
#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <algorithm>
#include <array>

#include "gen/diagnostic/assert.h"

// What GiNaC's macros declare is of this file alone: other files call the functions below.
namespace dyngen {
namespace {

using cln::cl_F;
using cln::cl_R;
using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

bool is_rational(const ex& x) {
  return GiNaC::is_a<numeric>(x) && x.info(GiNaC::info_flags::rational);
}

bool is_float(const ex& x) { return GiNaC::is_a<numeric>(x) && ex_to<numeric>(x).is_real(); }

/// @return true and the root if the number is the square of a rational one
bool rational_root(const ex& x, ex& root) {
  if (!is_rational(x) || ex_to<numeric>(x).is_negative()) return false;
  cln::cl_RA result;
  if (!cln::sqrtp(cln::the<cln::cl_RA>(ex_to<numeric>(x).to_cl_N()), &result)) return false;
  root = numeric(result);
  return true;
}

DECLARE_FUNCTION_1P(absolute_value)
DECLARE_FUNCTION_2P(smaller_of)
DECLARE_FUNCTION_2P(larger_of)
DECLARE_FUNCTION_1P(root_of)
DECLARE_FUNCTION_2P(power_of)
DECLARE_FUNCTION_1P(mean_of_decay)
DECLARE_FUNCTION_1P(slope_of_decay)

// |x|

ex absolute_eval(const ex& x) {
  if (is_float(x)) return GiNaC::abs(ex_to<numeric>(x));
  return absolute_value(x).hold();
}
ex absolute_evalf(const ex& x) { return absolute_eval(x); }
ex absolute_derivative(const ex& x, unsigned) { return GiNaC::csgn(x); }

// min, max

ex smaller_eval(const ex& a, const ex& b) {
  if (a.is_equal(b)) return a;
  if (is_float(a) && is_float(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? a : b;
  return smaller_of(a, b).hold();
}
ex smaller_evalf(const ex& a, const ex& b) { return smaller_eval(a, b); }
ex smaller_derivative(const ex& a, const ex& b, unsigned which) {
  return (1 + GiNaC::csgn(which == 0 ? b - a : a - b)) / 2;
}

ex larger_eval(const ex& a, const ex& b) {
  if (a.is_equal(b)) return a;
  if (is_float(a) && is_float(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? b : a;
  return larger_of(a, b).hold();
}
ex larger_evalf(const ex& a, const ex& b) { return larger_eval(a, b); }
ex larger_derivative(const ex& a, const ex& b, unsigned which) {
  return (1 + GiNaC::csgn(which == 0 ? a - b : b - a)) / 2;
}

// sqrt

ex root_eval(const ex& x) {
  ex root;
  if (rational_root(x, root)) return root;
  return root_of(x).hold();
}
ex root_evalf(const ex& x) {
  if (is_float(x)) return GiNaC::sqrt(ex_to<numeric>(x)).evalf();
  return root_of(x).hold();
}
ex root_derivative(const ex& x, unsigned) { return 1 / (2 * root_of(x)); }

// x^y

ex power_eval(const ex& x, const ex& y) {
  if (y.is_zero()) return 1;
  if (y.is_equal(1)) return x;
  if (is_rational(x) && y.info(GiNaC::info_flags::integer) && !x.is_zero()) {
    return GiNaC::pow(x, y);
  }
  return power_of(x, y).hold();
}
ex power_evalf(const ex& x, const ex& y) {
  if (!is_float(x) || !is_float(y)) return power_of(x, y).hold();
  return x.is_zero() ? ex(0) : ex(GiNaC::pow(x, y).evalf());
}
/// At 0 it is that of a tiny x: a product with a factor that is 0 there is a number then.
ex power_derivative(const ex& x, const ex& y, unsigned which) {
  const ex positive = larger_of(x, GiNaC::pow(ex(10), -30));
  return which == 0 ? ex(y * power_of(positive, y - 1)) : ex(power_of(x, y) * GiNaC::log(positive));
}

// phi and its derivative. For |x| <= 1 the terms of their series, which is where 1 - exp(-x) loses
// digits.

/// A float with as many digits as GiNaC works with, and some more.
cl_F to_float(const ex& x) {
  const auto format = cln::float_format(static_cast<std::uintptr_t>(long(GiNaC::Digits)) + 10);
  return cln::cl_float(cln::the<cl_R>(ex_to<numeric>(x).to_cl_N()), format);
}

/// Sum of weight(k) (-x)^k / (k + 1)! over k = first, first + 1, ... divided by x^first.
template <class Weight>
cl_F decay_series(const cl_F& x, int first, Weight weight) {
  cl_F power = cln::cl_float(1, x);  // (-x)^(k - first) / (k + 1)!, with the sign of the first
  for (int k = 1; k <= first; ++k) power = -power / (k + 1);
  cl_F sum = cln::cl_float(0, x);
  const cl_F smallest = cln::float_epsilon(cln::float_format(x));
  for (int k = first; cln::abs(power) * (k + 1) > smallest; ++k) {
    sum = sum + power * weight(k);
    power = -power * x / (k + 2);
  }
  return sum;
}

ex mean_eval(const ex& x) {
  if (x.is_zero()) return 1;
  return mean_of_decay(x).hold();
}
ex mean_evalf(const ex& x) {
  if (!is_float(x)) return mean_of_decay(x).hold();
  const cl_F value = to_float(x);
  if (GiNaC::abs(ex_to<numeric>(x)) <= 1)
    return numeric(decay_series(value, 0, [](int) { return 1; }));
  return numeric(cl_F((1 - cln::exp(-value)) / value));
}
ex mean_derivative(const ex& x, unsigned) { return slope_of_decay(x); }

ex slope_eval(const ex& x) {
  if (x.is_zero()) return -ex(1) / 2;
  return slope_of_decay(x).hold();
}
ex slope_evalf(const ex& x) {
  if (!is_float(x)) return slope_of_decay(x).hold();
  const cl_F value = to_float(x);
  if (GiNaC::abs(ex_to<numeric>(x)) <= 1)
    return numeric(decay_series(value, 1, [](int k) { return k; }));
  return numeric(cl_F(((1 + value) * cln::exp(-value) - 1) / cln::square(value)));
}
/// From x phi(x) = 1 - exp(-x), differentiated twice.
ex slope_derivative(const ex& x, unsigned) { return -(GiNaC::exp(-x) + 2 * slope_of_decay(x)) / x; }

REGISTER_FUNCTION(
    absolute_value,
    eval_func(absolute_eval).evalf_func(absolute_evalf).derivative_func(absolute_derivative))
REGISTER_FUNCTION(
    smaller_of,
    eval_func(smaller_eval).evalf_func(smaller_evalf).derivative_func(smaller_derivative))
REGISTER_FUNCTION(
    larger_of, eval_func(larger_eval).evalf_func(larger_evalf).derivative_func(larger_derivative))
REGISTER_FUNCTION(root_of,
                  eval_func(root_eval).evalf_func(root_evalf).derivative_func(root_derivative))
REGISTER_FUNCTION(power_of,
                  eval_func(power_eval).evalf_func(power_evalf).derivative_func(power_derivative))
REGISTER_FUNCTION(mean_of_decay,
                  eval_func(mean_eval).evalf_func(mean_evalf).derivative_func(mean_derivative))
REGISTER_FUNCTION(slope_of_decay,
                  eval_func(slope_eval).evalf_func(slope_evalf).derivative_func(slope_derivative))

struct Call {
  const char* name;        ///< ours
  const char* registered;  ///< GiNaC's
  std::size_t arguments;
  ex (*make)(const std::vector<ex>& arguments);
};

constexpr std::array<Call, 13> kCalls = {{
    {"sin", "sin", 1, [](const std::vector<ex>& x) { return ex(GiNaC::sin(x[0])); }},
    {"cos", "cos", 1, [](const std::vector<ex>& x) { return ex(GiNaC::cos(x[0])); }},
    {"sign", "csgn", 1, [](const std::vector<ex>& x) { return ex(GiNaC::csgn(x[0])); }},
    {"exp", "exp", 1, [](const std::vector<ex>& x) { return ex(GiNaC::exp(x[0])); }},
    {"log", "log", 1, [](const std::vector<ex>& x) { return ex(GiNaC::log(x[0])); }},
    {"tanh", "tanh", 1, [](const std::vector<ex>& x) { return ex(GiNaC::tanh(x[0])); }},
    {"abs", "absolute_value", 1, [](const std::vector<ex>& x) { return real_abs(x[0]); }},
    {"min", "smaller_of", 2, [](const std::vector<ex>& x) { return real_min(x[0], x[1]); }},
    {"max", "larger_of", 2, [](const std::vector<ex>& x) { return real_max(x[0], x[1]); }},
    {"sqrt", "root_of", 1, [](const std::vector<ex>& x) { return real_sqrt(x[0]); }},
    {"pow", "power_of", 2, [](const std::vector<ex>& x) { return real_pow(x[0], x[1]); }},
    {"phi", "mean_of_decay", 1, [](const std::vector<ex>& x) { return decay_mean(x[0]); }},
    {"dphi", "slope_of_decay", 1, [](const std::vector<ex>& x) { return decay_mean_slope(x[0]); }},
}};

/// Derivatives of sign, which GiNaC leaves as they stand, become 0.
struct DropSignDerivatives : public GiNaC::map_function {
  ex operator()(const ex& part) override {
    if (GiNaC::is_a<GiNaC::fderivative>(part)) {
      DYNGEN_ASSERT(ex_to<GiNaC::function>(part).get_name() == "csgn",
                    "a call without a derivative");
      return 0;
    }
    return part.map(*this);
  }
};

}  // namespace

ex real_abs(const ex& x) { return absolute_value(x); }
ex real_min(const ex& a, const ex& b) { return smaller_of(a, b); }
ex real_max(const ex& a, const ex& b) { return larger_of(a, b); }
ex real_sqrt(const ex& x) { return root_of(x); }
ex real_pow(const ex& x, const ex& y) { return power_of(x, y); }
ex decay_mean(const ex& x) { return mean_of_decay(x); }
ex decay_mean_slope(const ex& x) { return slope_of_decay(x); }

std::string call_name(const ex& call) {
  if (!GiNaC::is_exactly_a<GiNaC::function>(call)) return {};
  const std::string registered = ex_to<GiNaC::function>(call).get_name();
  const auto found = std::find_if(kCalls.begin(), kCalls.end(), [&](const Call& candidate) {
    return candidate.registered == registered;
  });
  return found == kCalls.end() ? std::string() : std::string(found->name);
}

ex make_call(const std::string& name, const std::vector<ex>& arguments) {
  const auto found = std::find_if(kCalls.begin(), kCalls.end(),
                                  [&](const Call& candidate) { return candidate.name == name; });
  DYNGEN_ASSERT(found != kCalls.end(), "there is no call " + name);
  DYNGEN_ASSERT(found->arguments == arguments.size(), "arguments of " + name);
  return found->make(arguments);
}

ex derivative_of(const ex& value, const GiNaC::symbol& variable) {
  DropSignDerivatives drop;
  return drop(value.diff(variable));
}

}  // namespace dyngen
