// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/page/page_parts.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace dyngen::runtime {

std::string joint_words(int joint) { return fmt::format("joint {}", joint + 1); }

std::string sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  if (text.back() != '.') text += '.';
  return text;
}

double entry_of(const Eigen::VectorXd& values, Eigen::Index joint) {
  return joint >= 0 && joint < values.size() ? values[joint]
                                             : std::numeric_limits<double>::quiet_NaN();
}

std::string torque_unit(const LinearModel& model, int joint) {
  return model.revolute[static_cast<std::size_t>(joint)] ? "N m" : "N";
}

ReportSection section_of(const std::string& id, const std::string& title,
                         std::vector<ReportBlock> blocks) {
  return {id, title, ReportSection::Kind::kPlain, {{"", "", "", std::move(blocks)}}};
}

ReportSection first_screen(const std::string& title, const std::string& sentence,
                           std::vector<ReportBlock> further, ReportArm arm, ReportBars bars) {
  ReportSection section{"verdict", title, ReportSection::Kind::kFirst, {}};
  ReportPart words{"", "", "", {}};
  words.blocks.emplace_back(ReportText{sentence, ReportText::Tone::kVerdict});
  for (ReportBlock& block : further) words.blocks.push_back(std::move(block));
  section.parts.push_back(std::move(words));
  if (!arm.joints.empty()) section.parts.push_back({"", "", "", {std::move(arm)}});
  if (!bars.groups.empty()) section.parts.push_back({"", "", "", {std::move(bars)}});
  return section;
}

ReportSection origin_section(const std::string& command, const std::string& words) {
  return section_of("origin", "How this was made", {ReportCode{command}, ReportText{words}});
}

}  // namespace dyngen::runtime
