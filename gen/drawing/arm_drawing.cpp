// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/arm_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gen/drawing/arm_parts.h"
#include "gen/drawing/body_shapes.h"
#include "gen/drawing/labels.h"
#include "gen/drawing/paper.h"
#include "gen/drawing/svg.h"
#include "gen/explain/place_text.h"
#include "gen/posture/posture.h"

namespace dyngen {
namespace {

constexpr double kWidth = 720, kHeight = 540;
/// Where the arm stands; words may stand a little beside it.
constexpr LabelPlacer::Box kArea = {80, 72, 640, 462};
constexpr LabelPlacer::Box kWordArea = {8, 56, 712, 480};
constexpr double kRodWidth = 8;
// told apart by the colour-blind too: after Okabe and Ito
constexpr const char* kRed = "#c8501e";
constexpr const char* kGreen = "#009e73";
constexpr const char* kBlue = "#0072b2";
constexpr const char* kInk = "#24292f";
constexpr const char* kGrey = "#57606a";

const char* axis_colour(char axis) { return axis == 'x' ? kRed : axis == 'y' ? kGreen : kBlue; }

const char* link_colour(int link) {
  if (link == 0) return "#3d444d";
  return link % 2 == 0 ? "#69737e" : "#a3acb6";
}

Vec3 upwards(const Posture& posture) {
  const Vec3 weight = posture.weight.value_or(Vec3{});
  return norm(weight) > 0 ? unit(-weight) : Vec3{0, 0, 1};
}

/// The view, with the arm as large as the area allows.
Paper fit(const ArmParts& parts, const Viewpoint& view) {
  Point low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
  const auto hold = [&](const Vec3& place) {
    const Point point = view.project(place);
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  };
  for (const ArmParts::Rod& rod : parts.rods) {
    hold(rod.from);
    hold(rod.to);
  }
  for (const ArmParts::Body& body : parts.bodies) hold(body.centre);
  for (const ArmParts::Arrow& arrow : parts.arrows) {
    hold(arrow.from + parts.arrow_length(arrow.axis) * arrow.direction);
  }
  hold(parts.ground.centre);
  const Point middle = 0.5 * (low + high);
  Paper paper;
  paper.view = view;
  paper.scale = std::min((kArea.right - kArea.left) / (high.x - low.x),
                         (kArea.bottom - kArea.top) / (high.y - low.y));
  paper.origin = {0.5 * (kArea.left + kArea.right) - paper.scale * middle.x,
                  0.5 * (kArea.top + kArea.bottom) + paper.scale * middle.y};
  return paper;
}

std::string rod_shape(const ArmParts::Rod& rod, const Paper& paper) {
  const Point from = paper.at(rod.from), to = paper.at(rod.to);
  const char* colour = link_colour(rod.link);
  return rod.open ? svg::line(from, to, colour, 0.6 * kRodWidth, "7,5")
                  : svg::line(from, to, colour, kRodWidth);
}

/// Ground, links and joints, the farthest first.
std::string solid_parts(const ArmParts& parts, const Posture& posture, const Paper& paper) {
  std::vector<std::pair<double, std::string>> shapes;
  for (const ArmParts::Rod& rod : parts.rods) {
    shapes.emplace_back(paper.view.depth(0.5 * (rod.from + rod.to)), rod_shape(rod, paper));
  }
  for (const ArmParts::Body& body : parts.bodies) {
    const PosedLink& link = posture.link(body.joint);
    const std::string shape = fmt::format(
        "<g class=\"joint\" id=\"joint-{0}\"><title>joint {0} {1} {2}</title>\n{3}</g>\n",
        body.joint, svg::escape(link.name), axis_place_text(link),
        body_shape(parts, body, link, paper));
    // a body is in front of the rods that end in it
    shapes.emplace_back(paper.view.depth(body.centre) + 0.3 * parts.size, shape);
  }
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first - 1e-9; });
  std::string text = ground_shape(parts, paper);
  for (const auto& [depth, shape] : shapes) text += shape;
  return text;
}

std::string arrow_name(const ArmParts::Arrow& arrow) {
  std::string text;
  for (const int frame : arrow.frames) {
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", arrow.axis, frame);
  }
  return text;
}

/// Axes of all frames, the long ones first: what points the same way stays visible.
std::string axes(const ArmParts& parts, const Paper& paper) {
  std::string text;
  for (const char axis : {'z', 'x', 'y'}) {
    for (const ArmParts::Arrow& arrow : parts.arrows) {
      if (arrow.axis != axis) continue;
      const Vec3 tip = arrow.from + parts.arrow_length(axis) * arrow.direction;
      text += fmt::format("<g class=\"axis\"><title>{}</title>\n{}</g>\n", arrow_name(arrow),
                          svg::arrow(paper.at(arrow.from), paper.at(tip), axis_colour(axis), 2));
    }
  }
  return text;
}

std::string tools(const ArmParts& parts, const Paper& paper) {
  std::string text;
  for (const Vec3& tool : parts.tools) {
    const Point at = paper.at(tool);
    text += "<g class=\"tool\"><title>end of the arm</title>\n" +
            svg::ellipse(at, 6, 6, 0, "#ffffff", kInk) +
            svg::line(at - Point{9, 0}, at + Point{9, 0}, kInk, 1.2) +
            svg::line(at - Point{0, 9}, at + Point{0, 9}, kInk, 1.2) + "</g>\n";
  }
  return text;
}

/// Words beside joints, axes and tools, where there is room.
class Words {
 public:
  Words(const ArmParts& parts, const Posture& posture, const Paper& paper)
      : parts_(parts), posture_(posture), paper_(paper), placer_(kWordArea) {
    avoid_parts();
    for (const char axis : {'z', 'x'}) name_axes(axis);
    for (const ArmParts::Body& body : parts_.bodies) name_joint(body);
    for (const Vec3& tool : parts_.tools) add(paper_.at(tool), {}, 10, "tool", {11, kInk});
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void avoid_parts() {
    for (const ArmParts::Rod& rod : parts_.rods) {
      placer_.avoid(paper_.at(rod.from), paper_.at(rod.to), 5);
    }
    for (const ArmParts::Arrow& arrow : parts_.arrows) {
      const Vec3 tip = arrow.from + parts_.arrow_length(arrow.axis) * arrow.direction;
      placer_.avoid(paper_.at(arrow.from), paper_.at(tip), 5);
    }
    const double half = 0.4 * parts_.body_length() * paper_.scale;
    for (const ArmParts::Body& body : parts_.bodies) {
      const Point at = paper_.at(body.centre);
      placer_.avoid(LabelPlacer::Box{at.x - half, at.y - half, at.x + half, at.y + half}, 1);
    }
  }

  /// @param free  px around the anchor that are the thing's own
  void add(const Point& anchor, const Point& towards, double free, const std::string& words,
           const svg::TextStyle& style) {
    const double width = svg::width_of(words, style.size), height = style.size + 1;
    const double far = length(towards);
    const Point start = far > 0 ? anchor + (free / far) * towards : anchor;
    const Point middle =
        placer_.place(start, towards, width + (far > 0 ? 0 : free), height + (far > 0 ? 0 : free));
    const double off = length(middle - anchor) - 0.5 * width;
    if (off > 34) text_ += svg::line(anchor, middle, "#8c959f", 0.8);
    text_ += svg::words({middle.x, middle.y + 0.36 * style.size}, words, style);
  }

  void name_axes(char axis) {
    for (const ArmParts::Arrow& arrow : parts_.arrows) {
      if (arrow.axis != axis) continue;
      const Point from = paper_.at(arrow.from);
      const Point tip = paper_.at(arrow.from + parts_.arrow_length(axis) * arrow.direction);
      add(tip, tip - from, 1, arrow_name(arrow), {11.5, axis_colour(axis)});
    }
  }

  void name_joint(const ArmParts::Body& body) {
    const PosedLink& link = posture_.link(body.joint);
    const std::string plain = fmt::format("joint{}", body.joint);
    const std::string name = link.name == plain ? fmt::format("joint {}", body.joint)
                                                : fmt::format("{} {}", body.joint, link.name);
    add(paper_.at(body.centre), {}, parts_.body_length() * paper_.scale * 0.8, name,
        {12.5, kInk, "middle", true});
  }

  const ArmParts& parts_;
  const Posture& posture_;
  const Paper& paper_;
  LabelPlacer placer_;
  std::string text_;
};

/// Where weight pulls: downwards on the paper.
std::string gravity(const Posture& posture, const Paper& paper) {
  const svg::TextStyle style = {12, kGrey, "end"};
  const Point corner = {kWidth - 16, 26};
  if (!posture.weight) return svg::words(corner, "gravity: known at run time", style);
  const double size = norm(*posture.weight);
  if (size == 0) return svg::words(corner, "no gravity", style);
  const Vec3 pull = unit(*posture.weight);
  const Point from = {kWidth - 28, 36}, way = paper.view.project(pull);
  return "<g class=\"gravity\">\n" +
         svg::words(corner,
                    fmt::format("gravity {:.4g} m/s^2 along {}", size, direction_text(pull)),
                    style) +
         svg::arrow(from, from + 56 * Point{way.x, -way.y}, kGrey, 3) + "</g>\n";
}

/// A length of 1, 2 or 5 that is at most 140 px long.
std::string scale_bar(const Paper& paper) {
  const double most = 140 / paper.scale;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double bar = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
  const Point from = {24, kHeight - 24}, to = {24 + bar * paper.scale, kHeight - 24};
  const Point tick = {0, 5};
  return "<g class=\"scale\">\n" + svg::line(from, to, kInk, 2) +
         svg::line(from - tick, from + tick, kInk, 2) + svg::line(to - tick, to + tick, kInk, 2) +
         svg::words({0.5 * (from.x + to.x), from.y - 9}, fmt::format("{:.3g} m", bar), {12, kInk}) +
         "</g>\n";
}

/// What the picture shows, at its lower edge.
std::string legend(const RobotModel& model, const ArmParts& parts) {
  std::string text;
  double x = kWidth - 16;
  for (const auto& [words, colour] : {std::pair("z (joint axis)", kBlue), std::pair("y", kGreen),
                                      std::pair("x", kRed), std::pair("axes of frames:", kGrey)}) {
    text += svg::words({x, kHeight - 18}, words, {11.5, colour, "end"});
    x -= svg::width_of(words, 11.5) + 8;
  }
  const bool open = std::any_of(parts.rods.begin(), parts.rods.end(),
                                [](const ArmParts::Rod& rod) { return rod.open; });
  std::string notes;
  if (model.convention == DhConvention::kStandard) {
    notes += "modified (proximal) frames of a standard table";
  }
  if (open) {
    notes += notes.empty() ? "" : "; ";
    notes += "dashed: goes on, no length in the file";
  }
  return text + svg::words({kWidth - 16, kHeight - 36}, notes, {11.5, kGrey, "end"});
}

std::string description(const Posture& posture) {
  std::string text;
  for (std::size_t i = 0; i < posture.links.size(); ++i) {
    text += fmt::format("Joint {} {}. ", i + 1, axis_place_text(posture.links[i]));
  }
  return text;
}

}  // namespace

std::string arm_drawing(const RobotModel& model) {
  const Posture posture = make_posture(model);
  const Vec3 up = upwards(posture);
  const ArmParts parts = arm_parts(posture, up);
  const Paper paper = fit(parts, choose_view(parts, up));
  std::string drawn_at = "drawn with " + configuration_text(posture);
  const std::string stand_ins = stand_in_text(posture);
  std::string text = svg::words({16, 26}, model.name, {16, kInk, "start", true}) +
                     svg::words({16, 45}, drawn_at, {12, kGrey, "start"});
  if (!stand_ins.empty()) text += svg::words({16, 61}, stand_ins, {12, kGrey, "start"});
  text += gravity(posture, paper) + solid_parts(parts, posture, paper) + tools(parts, paper) +
          axes(parts, paper) + Words(parts, posture, paper).text() + scale_bar(paper) +
          legend(model, parts);
  return svg::file(kWidth, kHeight,
                   fmt::format("{}: frames, {}", model.name, configuration_text(posture)),
                   description(posture), text);
}

}  // namespace dyngen
