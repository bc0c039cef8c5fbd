// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_input/robot_input.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "gen/mjcf/mjcf_reader.h"
#include "gen/symoro/par_reader.h"
#include "gen/urdf/urdf_reader.h"

namespace dyngen {

namespace {

/// The name of the root element, found without a parser: messages about XML that cannot be read
/// need it. Empty: there is none.
std::string_view root_name(std::string_view text) {
  std::size_t at = 0;
  while ((at = text.find('<', at)) != text.npos) {
    if (text.substr(at).starts_with("<!--")) {
      at = text.find("-->", at);
    } else if (text.substr(at).starts_with("<?") || text.substr(at).starts_with("<!")) {
      at = text.find('>', at);
    } else {
      const std::size_t end = text.find_first_of(" \t\r\n/>", at + 1);
      return text.substr(at + 1, end == text.npos ? end : end - at - 1);
    }
  }
  return {};
}

std::string_view spelled_form(RobotForm form) {
  switch (form) {
    case RobotForm::kSymoro:
      return "a SYMORO file";
    default:
      return "a robot file";
  }
}

[[noreturn]] void throw_message(const RobotSource& source, const std::string& text,
                                SourcePosition position, const std::string& message,
                                const std::string& hint) {
  Diagnostics diagnostics(source.path, text);
  diagnostics.error(position, 1, message, hint);
  throw ModelError(diagnostics.render());
}

/// --base and the like choose among links that have names.
void refuse_links_of_table(const RobotSource& source, const std::string& text, RobotForm form) {
  if (source.part_if_any) return;
  if (source.base.empty() && source.tip.empty() && source.round_angles == 0) return;
  const std::string option = !source.base.empty()  ? "--base"
                             : !source.tip.empty() ? "--tip"
                                                   : "--round-angles";
  throw_message(source, text, {1, 1},
                fmt::format("{} is for URDF and MJCF; this is {}", option, spelled_form(form)),
                "write what is meant in its rows");
}

[[noreturn]] void refuse_xml(const RobotSource& source, const std::string& text) {
  const std::string_view root = root_name(text);
  const std::string name = printable(root);
  const std::size_t byte = root.empty() ? 0 : static_cast<std::size_t>(root.data() - text.data());
  const SourcePosition position = LineTable(text).position_of(text, byte);
  if (root == "sdf" || root == "world" || root == "model") {
    throw_message(source, text, position,
                  fmt::format("this is SDF (root <{}>), which is not read", name),
                  "URDF and MJCF are: convert it, for instance by sdformat_urdf or sdf2urdf");
  }
  throw_message(
      source, text, position,
      fmt::format("this is XML with the root <{}>, no description of a robot that is read", name),
      "URDF has the root <robot>, MJCF <mujoco>");
}

RobotFile parse_bodies(std::string text, const RobotSource& source, const FurtherCheck& further) {
  auto bodies = std::make_shared<const DescribedBodies>(read_bodies(std::move(text), source));
  MadeText made;
  made.text = bodies->robot.text;
  made.source_text = bodies->document.text;
  made.made_of = bodies->robot.tree.format;
  made.place = [bodies](RowKey key, std::size_t column) {
    const TextPlace place = origin_of(bodies->robot, key, column);
    return MadeText::Place{place.position, place.length};
  };
  made.warnings = bodies->warnings;
  return parse_made_robot_file(std::move(made), source.path, further);
}

}  // namespace

RobotForm robot_form(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '<') {
    const std::string_view root = root_name(text);
    if (root == "robot") return RobotForm::kUrdf;
    if (root == "mujoco") return RobotForm::kMjcf;
    return RobotForm::kOtherXml;
  }
  return is_symoro_text(text) ? RobotForm::kSymoro : RobotForm::kRobotFile;
}

DescribedBodies read_bodies(std::string text, const RobotSource& source) {
  DescribedBodies result;
  result.form = robot_form(text);
  if (result.form == RobotForm::kOtherXml) refuse_xml(source, text);
  result.document = parse_xml(std::move(text), source.path);
  const ReadingOptions options{static_cast<Real>(source.round_angles)};
  BodyTree tree = result.form == RobotForm::kMjcf ? read_mjcf(result.document, options)
                                                  : read_urdf(result.document, options);
  Diagnostics diagnostics(source.path, result.document.text);
  result.warnings = tree.warnings;
  result.robot =
      converted_robot(std::move(tree), {source.base, source.tip}, source.path, diagnostics);
  result.warnings.insert(result.warnings.end(), result.robot.robot.warnings.begin(),
                         result.robot.robot.warnings.end());
  return result;
}

RobotFile parse_robot(std::string text, const RobotSource& source, const FurtherCheck& further) {
  const RobotForm form = robot_form(text);
  switch (form) {
    case RobotForm::kUrdf:
    case RobotForm::kMjcf:
      return parse_bodies(std::move(text), source, further);
    case RobotForm::kOtherXml:
      refuse_xml(source, text);
    case RobotForm::kSymoro:
      refuse_links_of_table(source, text, form);
      return parse_made_robot_file(read_par(std::move(text), source.path), source.path, further);
    case RobotForm::kRobotFile:
      break;
  }
  refuse_links_of_table(source, text, form);
  return parse_robot_file(std::move(text), source.path, further);
}

RobotFile read_robot_file(const RobotSource& source, const FurtherCheck& further) {
  return parse_robot(read_description(source.path), source, further);
}

}  // namespace dyngen
