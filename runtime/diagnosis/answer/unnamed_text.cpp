// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/unnamed_text.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace dyngen::runtime {
namespace {

std::string numbers_of(const EffectInstance& effect) {
  std::string numbers;
  for (int p = 0; p < effect.law.size(); ++p) {
    numbers +=
        fmt::format("{}{} {:.3g}", numbers.empty() ? "" : ", ",
                    effect.law.parameters[static_cast<std::size_t>(p)].name, effect.parameters[p]);
  }
  return numbers;
}

std::string shape_of(const GenericStructure& structure) {
  switch (structure.form) {
    case GenericStructure::Form::kLine:
      return fmt::format("most of it a sinusoid of {:.3g} Hz, with a phase of its own in each run",
                         structure.frequency[0]);
    case GenericStructure::Form::kRepeats:
      return fmt::format(
          "below {:.3g} Hz, which comes back in every period of the motion and is no function of "
          "one or two of its variables that was tried",
          structure.frequency[0]);
    case GenericStructure::Form::kWave: {
      const std::vector<std::string> names = structure.names();
      return fmt::format("most of it a sinusoid of about {:.2g} {} {} {:.2g} {}",
                         structure.frequency[0], names[0], structure.frequency[1] < 0 ? "-" : "+",
                         std::abs(structure.frequency[1]), names[1]);
    }
    case GenericStructure::Form::kSpeeds:
      return "a function of the product of velocities that no effect of the catalogue is";
    default:
      return "in a shape that no effect of the catalogue has";
  }
}

std::string shape_of(const Nameless& nameless) {
  if (!nameless.costly.empty()) {
    return fmt::format(
        "more than noise; {} would explain it, with more parameters than these data pay for",
        nameless.costly);
  }
  if (nameless.ruled_out) {
    return fmt::format("of the form of {} ({}), which cannot be its name: {}",
                       short_name(*nameless.ruled_out), numbers_of(*nameless.ruled_out),
                       nameless.objection);
  }
  return shape_of(nameless.structure);
}

}  // namespace

std::vector<Unexplained> described(const std::vector<Nameless>& nameless) {
  std::vector<Unexplained> all;
  for (const Nameless& each : nameless) {
    Unexplained unexplained;
    unexplained.joint = each.structure.joint;
    unexplained.variables = each.names();
    unexplained.rms = each.rms;
    unexplained.description =
        fmt::format("torque of joint {} that goes with {}, rms {:.3g}, {}", unexplained.joint + 1,
                    fmt::join(unexplained.variables, " and "), unexplained.rms, shape_of(each));
    all.push_back(std::move(unexplained));
  }
  return all;
}

}  // namespace dyngen::runtime
