// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "runtime/wind_up/wind_up.h"

namespace dyngen::runtime {

std::string wind_up_sentence(const WindUpResult& result) {
  if (!result.judged) return result.why_not;
  const char* unit = result.revolute ? "N m/rad" : "N/m";
  std::string text =
      fmt::format("ql is {:.3g} ms {} than q ({:.3g} to {:.3g}).",
                  1e3 * std::abs(result.delay.value), result.delay.value < 0 ? "earlier" : "later",
                  1e3 * result.delay.low, 1e3 * result.delay.high);
  const WindUpNumber& k = result.stiffness;
  if (k.seen && std::isfinite(k.high)) {
    text += fmt::format(" Stiffness {:.3g} {} ({:.3g} to {:.3g}).", k.value, unit, k.low, k.high);
  } else if (k.low > 0 && std::isfinite(k.low)) {
    text += fmt::format(" Stiffness above {:.3g} {}.", k.low, unit);
  } else {
    text += " The stiffness is not determined.";
  }
  return text;
}

std::string compared_compliance(const WindUpResult& result, double compliance, double deviation,
                                const std::string& where) {
  const WindUpNumber& own = result.compliance;
  if (!result.judged || !std::isfinite(own.low) || !std::isfinite(own.high)) return {};
  const double low = compliance - 2 * deviation, high = compliance + 2 * deviation;
  const char* unit = result.revolute ? "rad/(N m)" : "m/N";
  const std::string numbers =
      fmt::format("c = {:.3g} {} of {} beside {:.3g} ({:.3g} to {:.3g}) from the two encoders",
                  compliance, unit, where, own.value, own.low, own.high);
  if (high < own.low || low > own.high) {
    return fmt::format("The encoders contradict the elasticity of joint {}: {}.", result.joint + 1,
                       numbers);
  }
  return fmt::format("The encoders agree with the elasticity of joint {}: {}.", result.joint + 1,
                     numbers);
}

std::string compared_with_none(const WindUpResult& result, double smallest) {
  if (!result.judged || !result.stiffness.seen) return {};
  const char* unit = result.revolute ? "rad/(N m)" : "m/N";
  const WindUpNumber& own = result.compliance;
  std::string text = fmt::format(
      "The torque alone shows no elasticity; the encoders show {:.3g} {}", own.value, unit);
  if (!std::isfinite(smallest)) {
    return text + ", and no size would have been found without the second encoder.";
  }
  return text + fmt::format(
                    ", and from {:.3g} on it would have been found without the second "
                    "encoder{}.",
                    smallest, smallest < own.low ? ": both contradict one another" : "");
}

}  // namespace dyngen::runtime
