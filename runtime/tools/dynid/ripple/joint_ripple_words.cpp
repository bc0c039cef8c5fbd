// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/tools/dynid/page/page_parts.h"
#include "runtime/tools/dynid/ripple/joint_ripple.h"

namespace dyngen::runtime {
namespace {

std::string order_words(const RippleLine& line) {
  return fmt::format("order {:.5g} +- {:.1g}", line.order.value,
                     line.order.high - line.order.value);
}

std::string note_of(const RippleLine& line, const std::string& found_as) {
  std::string note = fmt::format("p = {:.1g}", line.chance);
  if (line.of_motor > 0) note += fmt::format(", {:.4g} of the motor", line.of_motor);
  if (!found_as.empty()) note += ", as " + found_as;
  return note;
}

/// "Order 48 grows", "Orders 48, 96 grow": of the lines of a joint that are so; empty: none is.
template <typename Is>
std::string of_orders(const RippleResult& result, const Is& is, const char* one, const char* many) {
  std::string orders;
  int count = 0;
  for (const RippleLine& line : result.lines) {
    if (!is(line)) continue;
    orders += fmt::format("{}{:.5g}", orders.empty() ? "" : ", ", line.order.value);
    ++count;
  }
  if (count == 0) return {};
  return fmt::format("{} {} {}", count == 1 ? "Order" : "Orders", orders, count == 1 ? one : many);
}

/// What lines are besides torques of the position.
std::vector<std::string> line_remarks(const RippleResult& result) {
  std::vector<std::string> remarks = {
      of_orders(
          result, [](const RippleLine& line) { return line.kind == RippleKind::kPosition; },
          "grows with speed and acceleration as a position error of the gear or the encoder does. "
          "It is not compensated.",
          "grow with speed and acceleration as position errors of the gear or the encoder do. They "
          "are not compensated."),
      of_orders(
          result, [](const RippleLine& line) { return line.open; },
          "may be a torque or a position error: the speed varies too little to tell.",
          "may be torques or position errors: the speed varies too little to tell."),
      of_orders(
          result, [](const RippleLine& line) { return line.by_speed; },
          "changes with the speed: a position error, a delay or the control loop has a part in it.",
          "change with the speed: a position error, a delay or the control loop has a part in "
          "them."),
      of_orders(
          result, [](const RippleLine& line) { return line.differs; },
          "differs between the directions.", "differ between the directions.")};
  if (result.cut_off) {
    remarks.push_back(
        fmt::format("More orders stand out; the search ended after {}.", result.lines.size()));
  }
  std::erase(remarks, std::string());
  return remarks;
}

std::string ruled_out_words(const RippleLine& line) {
  if (line.kind == RippleKind::kImage) {
    return fmt::format(
        "Order {:.5g} may be the image of order {:.5g} above Nyquist: the joint moves at one "
        "speed. "
        "It is no ripple here.",
        line.order.value, line.rival);
  }
  return fmt::format(
      "Order {:.5g} is no ripple: a fixed frequency of {:.4g} Hz explains it as well.",
      line.order.value, line.rival);
}

ReportView view_of(const JointRipple& own) {
  const RippleResult& result = own.result;
  ReportPanel panel;
  panel.x_label = "order [periods per turn]";
  panel.y_label = "amplitude [N m]";
  panel.x = result.shown_order;
  panel.series.push_back(
      {"torque less the slow model", Role::kData, result.shown_amplitude, {}, {}, false, false});
  panel.series.push_back({"limit of noise", Role::kFloor, result.shown_noise, {}, {}, true, false});
  if (!result.lines.empty()) {
    ReportCloud cloud{"ripple", Role::kModel, {}, {}};
    const auto count = static_cast<Eigen::Index>(result.lines.size());
    cloud.x.resize(count);
    cloud.y.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const RippleLine& line = result.lines[static_cast<std::size_t>(i)];
      cloud.x[i] = line.order.value;
      cloud.y[i] = line.both.amplitude.value;
    }
    panel.clouds.push_back(std::move(cloud));
  }
  return {joint_words(result.joint), {std::move(panel)}};
}

std::vector<std::string> all_remarks(const JointRipples& ripples) {
  std::vector<std::string> remarks;
  for (const JointRipple& own : ripples.joints) {
    const auto add = [&](const std::string& remark) {
      remarks.push_back(fmt::format("{}: {}", joint_words(own.result.joint), remark));
    };
    for (const std::string& remark : line_remarks(own.result)) add(remark);
    for (const RippleLine& line : own.result.ruled_out) add(ruled_out_words(line));
    for (const std::string& remark : own.remarks) add(remark);
  }
  remarks.insert(remarks.end(), ripples.remarks.begin(), ripples.remarks.end());
  return remarks;
}

}  // namespace

std::vector<RippleTextLine> ripple_lines(const JointRipples& ripples) {
  std::vector<RippleTextLine> lines;
  for (const JointRipple& own : ripples.joints) {
    const RippleResult& result = own.result;
    if (!result.judged && result.moving == 0) continue;  // it stands, as is said elsewhere
    if (!result.judged) {
      lines.push_back({result.joint, "not judged", "", "", result.why_not});
      continue;
    }
    for (std::size_t i = 0; i < result.lines.size(); ++i) {
      const RippleLine& line = result.lines[i];
      const RippleNumber& amplitude = line.both.amplitude;
      lines.push_back({result.joint, order_words(line), fmt::format("{:.3g} N m", amplitude.value),
                       fmt::format("{:.3g} .. {:.3g}", amplitude.low, amplitude.high),
                       note_of(line, own.found_as[i])});
    }
    if (result.cut_off) continue;
    lines.push_back({result.joint, result.lines.empty() ? "orders" : "other orders", "not seen",
                     fmt::format("below {:.3g} N m", result.below),
                     fmt::format("{:.3g} to {:.4g}", result.least_order, result.most_order)});
  }
  return lines;
}

std::string ripple_text(const JointRipples& ripples) {
  if (!ripples.any()) return {};
  std::string text = "\nripple, periods per turn of the joint, 95 % intervals\n";
  int joint = -1;
  for (const RippleTextLine& line : ripple_lines(ripples)) {
    text += fmt::format("{:<8}{:<21}{:<12}{:<20}{}",
                        line.joint != joint ? fmt::format("joint {}", line.joint + 1) : "",
                        line.quantity, line.value, line.interval, line.note);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
    joint = line.joint;
  }
  for (const std::string& remark : all_remarks(ripples)) text += remark + "\n";
  return text;
}

std::vector<std::string> ripple_comment(const JointRipples& ripples) {
  std::vector<std::string> comment;
  for (const JointRipple& own : ripples.joints) {
    for (std::size_t i = 0; i < own.result.lines.size(); ++i) {
      const RippleLine& line = own.result.lines[i];
      if (!makes_row(own, i)) continue;
      comment.push_back(fmt::format(
          "  ripple of {}: order {:.6g} +- {:.1g}, {:.3g} N m ({:.3g} to "
          "{:.3g})",
          joint_words(own.result.joint), line.order.value, line.order.high - line.order.value,
          line.both.amplitude.value, line.both.amplitude.low, line.both.amplitude.high));
    }
  }
  return comment;
}

ReportSection ripple_section(const JointRipples& ripples) {
  ReportTable table{{"", "", "amplitude", "95 % interval", ""}, {}, kRowsShown};
  for (const RippleTextLine& line : ripple_lines(ripples)) {
    table.rows.push_back(
        {joint_words(line.joint), line.quantity, line.value, line.interval, line.note});
  }
  std::vector<ReportBlock> blocks = {std::move(table)};
  std::vector<std::string> remarks = all_remarks(ripples);
  if (!remarks.empty()) blocks.emplace_back(ReportList{std::move(remarks)});
  ReportChart chart;
  chart.id = "order-spectrum";
  chart.title = "Order spectrum of the torque";
  chart.caption =
      "Amplitude of each order in the torque at full rate, less the slow model. An order above the "
      "limit is found: noise is as large in one of 4000 joints.";
  chart.choice = "joint";
  for (const JointRipple& own : ripples.joints) {
    if (own.result.judged) chart.views.push_back(view_of(own));
  }
  if (!chart.views.empty()) blocks.emplace_back(std::move(chart));
  return section_of("ripple", "Ripple: orders of the joint's angle", std::move(blocks));
}

}  // namespace dyngen::runtime
