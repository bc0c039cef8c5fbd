// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "runtime/tools/dynid/page/page_parts.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {
namespace {

std::string digits_of(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("infinite");
}

/// A quantity of a joint: its value where it is seen, else the bound of its size.
WindUpLine line_of(const WindUpResult& result, const char* quantity, const WindUpNumber& own,
                   double factor, const std::string& unit, std::string note = {}) {
  WindUpLine line{result.joint, quantity, {}, {}, std::move(note)};
  if (own.seen) {
    line.value = fmt::format("{} {}", digits_of(factor * own.value), unit);
    line.interval =
        fmt::format("{} .. {}", digits_of(factor * own.low), digits_of(factor * own.high));
  } else {
    line.value = "not seen";
    line.interval = std::isfinite(own.below)
                        ? fmt::format("below {} {}", digits_of(factor * own.below), unit)
                        : "not determined";
  }
  return line;
}

WindUpLine delay_line(const WindUpResult& result) {
  const WindUpNumber& own = result.delay;
  return {result.joint,
          "delay of ql",
          fmt::format("{} ms", digits_of(1e3 * own.value)),
          fmt::format("{} .. {}", digits_of(1e3 * own.low), digits_of(1e3 * own.high)),
          {}};
}

WindUpLine stiffness_line(const WindUpResult& result) {
  const WindUpNumber& own = result.stiffness;
  const std::string unit = result.revolute ? "N m/rad" : "N/m";
  WindUpLine line{result.joint, "stiffness", {}, {}, {}};
  const bool determined = own.low > 0 && std::isfinite(own.low);
  line.value = own.value > 0 && std::isfinite(own.value) && determined
                   ? fmt::format("{} {}", digits_of(own.value), unit)
                   : std::string("not seen");
  line.interval = determined ? fmt::format("{} .. {}", digits_of(own.low), digits_of(own.high))
                             : std::string("not determined");
  return line;
}

WindUpLine backlash_line(const WindUpResult& result, const std::string& unit) {
  if (result.backlash_decided) return line_of(result, "backlash", result.backlash, 1, unit);
  return {result.joint, "backlash", "not decided", "", "the load keeps its sign"};
}

void add_orders(const WindUpResult& result, const std::string& unit,
                std::vector<WindUpLine>& lines) {
  for (const GearErrorLine& own : result.lines) {
    WindUpLine line = line_of(
        result, "", own.amplitude, 1, unit,
        fmt::format("p = {:.1g}{}", own.chance,
                    own.of_motor > 0 ? fmt::format(", {:.4g} of the motor", own.of_motor) : ""));
    line.quantity = fmt::format("order {:.4g}", own.order);
    lines.push_back(std::move(line));
  }
  if (result.most_order > 0) {
    lines.push_back({result.joint, "other orders", "not seen",
                     fmt::format("below {} {}", digits_of(result.lines_below), unit),
                     fmt::format("{:.3g} to {:.3g}", result.least_order, result.most_order)});
  }
}

ReportChart chart_of(const WindUpResult& result) {
  const std::string unit = result.revolute ? "rad" : "m";
  ReportChart chart;
  chart.id = fmt::format("wind-up-joint-{}", result.joint + 1);
  chart.title = fmt::format("Torque over wind-up of joint {}", result.joint + 1);
  chart.caption =
      "Wind-up: q less ql, without delay, offset and gear error. Torque: what the gear passes to "
      "the link, of the rigid model. The slope is the stiffness.";
  ReportPanel panel;
  panel.x_label = fmt::format("wind-up [{}]", unit);
  panel.y_label = fmt::format("torque [{}]", result.revolute ? "N m" : "N");
  panel.clouds.push_back({"measured", Role::kData, result.shown_wind_up, result.shown_load});
  panel.clouds.push_back({"fitted", Role::kModel, result.shown_fit, result.shown_load});
  chart.views.push_back({"wind-up", {std::move(panel)}});
  return chart;
}

}  // namespace

std::vector<WindUpLine> wind_up_lines(const TwoEncoders& encoders) {
  std::vector<WindUpLine> lines;
  for (const WindUpResult& result : encoders.joints) {
    if (!result.judged) {
      lines.push_back({result.joint, "not judged", "", "", result.why_not});
      continue;
    }
    const std::string unit = result.revolute ? "rad" : "m";
    lines.push_back(delay_line(result));
    lines.push_back(stiffness_line(result));
    lines.push_back(line_of(result, "hardening", result.hardening, 1,
                            result.revolute ? "rad/(N m)^3" : "m/N^3"));
    lines.push_back(line_of(result, "hysteresis", result.hysteresis, 1, unit,
                            result.hysteresis.seen ? "by " + result.hysteresis_driver : ""));
    lines.push_back(backlash_line(result, unit));
    lines.push_back(line_of(result, "slow gear error", result.slow_error, 1, unit));
    add_orders(result, unit, lines);
    if (result.rotor_estimated) {
      lines.push_back(line_of(result, "rotor", result.rotor, 1, result.revolute ? "kg m^2" : "kg",
                              "at the joint"));
    }
  }
  return lines;
}

std::string two_encoders_text(const TwoEncoders& encoders) {
  if (!encoders.any()) return {};
  std::string text = "\ntwo encoders, 95 % intervals\n";
  int joint = -1;
  for (const WindUpLine& line : wind_up_lines(encoders)) {
    text += fmt::format("{:<8}{:<16}{:<17}{:<24}{}",
                        line.joint != joint ? fmt::format("joint {}", line.joint + 1) : "",
                        line.quantity, line.value, line.interval, line.note);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
    joint = line.joint;
  }
  for (const WindUpResult& result : encoders.joints) {
    for (const std::string& remark : result.remarks) {
      text += fmt::format("joint {}: {}\n", result.joint + 1, remark);
    }
  }
  for (const std::string& remark : encoders.remarks) text += remark + "\n";
  return text;
}

void compare_elasticity(TwoEncoders& encoders, const std::vector<ElasticityElsewhere>& elsewhere) {
  for (WindUpResult& result : encoders.joints) {
    for (const ElasticityElsewhere& own : elsewhere) {
      if (own.joint != result.joint) continue;
      const std::string words =
          own.found ? compared_compliance(result, own.compliance, own.deviation, own.where)
                    : compared_with_none(result, own.compliance);
      if (!words.empty()) result.remarks.push_back(words);
    }
  }
}

ReportSection two_encoders_section(const TwoEncoders& encoders) {
  ReportTable table{{"", "", "value", "95 % interval", ""}, {}, 0};
  for (const WindUpLine& line : wind_up_lines(encoders)) {
    table.rows.push_back(
        {joint_words(line.joint), line.quantity, line.value, line.interval, line.note});
  }
  std::vector<ReportBlock> blocks = {std::move(table)};
  std::vector<std::string> remarks;
  for (const WindUpResult& result : encoders.joints) {
    for (const std::string& remark : result.remarks) {
      remarks.push_back(fmt::format("{}: {}", joint_words(result.joint), remark));
    }
  }
  remarks.insert(remarks.end(), encoders.remarks.begin(), encoders.remarks.end());
  if (!remarks.empty()) blocks.emplace_back(ReportList{std::move(remarks)});
  for (const WindUpResult& result : encoders.joints) {
    if (result.judged) blocks.emplace_back(chart_of(result));
  }
  return section_of("two-encoders", "Two encoders: torque over wind-up", std::move(blocks));
}

}  // namespace dyngen::runtime
