// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace dyngen {

/// Functions of real numbers that GiNaC lacks, or knows for complex numbers only. Their names in
/// expressions are abs, min, max, sqrt, pow and phi; what GiNaC has itself is sin, cos, exp, log,
/// tanh, and sign (csgn).
///
/// Each has its derivative: |x|' = sign(x); min and max follow the smaller and the larger argument,
/// and their mean where both are equal.

/// |x|
GiNaC::ex real_abs(const GiNaC::ex& x);
/// The smaller, the larger of two numbers.
GiNaC::ex real_min(const GiNaC::ex& a, const GiNaC::ex& b);
GiNaC::ex real_max(const GiNaC::ex& a, const GiNaC::ex& b);
/// The root of x >= 0; its derivative at 0 is not finite.
GiNaC::ex real_sqrt(const GiNaC::ex& x);
/// x^y of x >= 0 and any exponent; its derivatives at 0 are those at 1e-30, which are finite. Small
/// whole powers are products: write GiNaC::pow for them.
GiNaC::ex real_pow(const GiNaC::ex& x, const GiNaC::ex& y);

/// phi(x) = (1 - exp(-x)) / x, 1 at x = 0: the part of a step in which a state that decays still
/// follows its input. dphi(x) is its derivative, -1/2 at x = 0.
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010, (2.10).
GiNaC::ex decay_mean(const GiNaC::ex& x);
GiNaC::ex decay_mean_slope(const GiNaC::ex& x);

/// Name of a call as forms, programs and C know it: sin, cos, sign, exp, log, tanh, abs, min, max,
/// sqrt, pow, phi, dphi. Empty if it is none of these.
std::string call_name(const GiNaC::ex& call);

/// The call of this name. @throws InternalError if there is none, or arguments do not fit
GiNaC::ex make_call(const std::string& name, const std::vector<GiNaC::ex>& arguments);

/// The derivative of an expression of these calls; that of sign is 0, which GiNaC's own diff() does
/// not know. The second derivative of phi is written as a quotient that has no value at 0.
GiNaC::ex derivative_of(const GiNaC::ex& value, const GiNaC::symbol& variable);

}  // namespace dyngen
