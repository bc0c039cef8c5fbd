// SPDX-License-Identifier: MIT
#include "runtime/report/document_json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

/// As many digits as a chart shows.
Json json_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}

/// Digits enough to tell neighbours apart that are closer than five digits of their size.
Json abscissae(const VectorXd& x) {
  Json array = Json::array();
  for (const double value : x) {
    array.push_back(std::isfinite(value)
                        ? Json(std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr))
                        : Json(nullptr));
  }
  return array;
}

Json numbers(const VectorXd& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(json_number(value));
  return array;
}

Json point(const ReportArm::Point& p) {
  return {json_number(p[0]), json_number(p[1]), json_number(p[2])};
}

const char* tone_name(ReportText::Tone tone) {
  switch (tone) {
    case ReportText::Tone::kQuiet:
      return "quiet";
    case ReportText::Tone::kVerdict:
      return "verdict";
    case ReportText::Tone::kPlain:
      break;
  }
  return "plain";
}

Json spelled(const ReportText& block) {
  return {{"type", "text"}, {"tone", tone_name(block.tone)}, {"text", block.text}};
}

Json spelled(const ReportList& block) { return {{"type", "list"}, {"items", block.items}}; }

Json spelled(const ReportFacts& block) {
  Json items = Json::array();
  for (const auto& fact : block.items) {
    items.push_back({{"label", fact.label}, {"value", fact.value}, {"note", fact.note}});
  }
  return {{"type", "facts"}, {"items", std::move(items)}};
}

Json spelled(const ReportTable& block) {
  Json rows = Json::array();
  for (const auto& row : block.rows) {
    Json cells = Json::array();
    for (const ReportCell& cell : row) {
      cells.push_back(cell.is_number ? json_number(cell.value) : Json(cell.text));
    }
    rows.push_back(std::move(cells));
  }
  return {{"type", "table"},
          {"header", block.header},
          {"shown", block.shown},
          {"rows", std::move(rows)}};
}

Json spelled(const ReportCode& block) { return {{"type", "code"}, {"text", block.text}}; }

Json spelled(const ReportFormula& block) { return {{"type", "formula"}, {"lines", block.lines}}; }

Json spelled(const ReportBars& block) {
  Json groups = Json::array();
  for (const ReportBarGroup& group : block.groups) {
    Json bars = Json::array();
    for (const ReportBar& bar : group.bars) {
      bars.push_back(
          {{"name", bar.name}, {"role", role_name(bar.role)}, {"value", json_number(bar.value)}});
    }
    groups.push_back({{"label", group.label},
                      {"unit", group.unit},
                      {"marked", group.marked},
                      {"bars", std::move(bars)}});
  }
  return {{"type", "bars"},
          {"id", block.id},
          {"title", block.title},
          {"caption", block.caption},
          {"groups", std::move(groups)}};
}

/// Rows of the lower triangle and the diagonal, in hundredths: a matrix of likeness is symmetric.
Json spelled(const ReportMatrix& block) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < block.values.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j <= i; ++j) {
      const double value = block.values(i, j);
      row.push_back(std::isfinite(value) ? Json(std::lround(100 * value)) : Json(nullptr));
    }
    rows.push_back(std::move(row));
  }
  return {{"type", "matrix"},         {"id", block.id},       {"title", block.title},
          {"caption", block.caption}, {"names", block.names}, {"hundredths", std::move(rows)}};
}

/// @param first  of the view: an x that is the same is left out
Json spelled(const ReportPanel& panel, const ReportPanel& first) {
  Json series = Json::array(), clouds = Json::array(), spans = Json::array();
  for (const ReportSeries& own : panel.series) {
    Json json = {{"name", own.name},
                 {"role", role_name(own.role)},
                 {"dashed", own.dashed},
                 {"marks", own.marks},
                 {"y", numbers(own.y)}};
    if (own.low.size() != 0) {
      json["low"] = numbers(own.low);
      json["high"] = numbers(own.high);
    }
    series.push_back(std::move(json));
  }
  for (const ReportCloud& own : panel.clouds) {
    clouds.push_back({{"name", own.name},
                      {"role", role_name(own.role)},
                      {"x", numbers(own.x)},
                      {"y", numbers(own.y)}});
  }
  for (const ReportSpan& own : panel.spans) {
    spans.push_back(
        {{"from", json_number(own.from)}, {"to", json_number(own.to)}, {"label", own.label}});
  }
  const bool again = &panel != &first && panel.x.size() == first.x.size() && panel.x == first.x;
  return {{"x_label", panel.x_label},
          {"y_label", panel.y_label},
          {"x", again ? Json(nullptr) : abscissae(panel.x)},
          {"series", std::move(series)},
          {"clouds", std::move(clouds)},
          {"spans", std::move(spans)}};
}

Json spelled(const ReportChart& block) {
  Json views = Json::array();
  for (const ReportView& view : block.views) {
    Json panels = Json::array();
    for (const ReportPanel& panel : view.panels) {
      panels.push_back(spelled(panel, view.panels.front()));
    }
    views.push_back({{"name", view.name}, {"panels", std::move(panels)}});
  }
  return {{"type", "chart"},          {"id", block.id},         {"title", block.title},
          {"caption", block.caption}, {"choice", block.choice}, {"same_as", block.same_as},
          {"views", std::move(views)}};
}

Json spelled(const ReportArm& block) {
  Json joints = Json::array();
  for (const ReportArm::Joint& own : block.joints) {
    Json link = Json::array();
    for (const auto& p : own.link) link.push_back(point(p));
    joints.push_back({{"label", own.label},
                      {"coordinate", own.coordinate},
                      {"prismatic", own.prismatic},
                      {"marked", own.marked},
                      {"at", point(own.at)},
                      {"axis", point(own.axis)},
                      {"link", std::move(link)}});
  }
  return {{"type", "arm"}, {"up", point(block.up)}, {"joints", std::move(joints)}};
}

const char* kind_name(ReportSection::Kind kind) {
  switch (kind) {
    case ReportSection::Kind::kFirst:
      return "first";
    case ReportSection::Kind::kFinding:
      return "finding";
    case ReportSection::Kind::kPlain:
      break;
  }
  return "plain";
}

/// What would end a script element, or a line of one.
std::string for_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else if (json.compare(i, 3, "\xe2\x80\xa8") == 0 || json.compare(i, 3, "\xe2\x80\xa9") == 0) {
      text += json[i + 2] == '\xa8' ? "\\u2028" : "\\u2029";
      i += 2;
    } else {
      text += c;
    }
  }
  return text;
}

std::string for_element(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("&#{};", static_cast<int>(c));
    } else {
      text +=
          static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e ? ' ' : c;
    }
  }
  return text;
}

void put(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t place = page.find(mark);
  if (place == std::string::npos) throw std::logic_error("the template has no " + mark);
  page.replace(place, mark.size(), text);
}

}  // namespace

std::string document_json(const ReportDocument& document) {
  document.validate();
  Json sections = Json::array();
  for (const ReportSection& section : document.sections) {
    Json parts = Json::array();
    for (const ReportPart& part : section.parts) {
      Json blocks = Json::array();
      for (const ReportBlock& block : part.blocks) {
        blocks.push_back(std::visit([](const auto& own) { return spelled(own); }, block));
      }
      parts.push_back({{"id", part.id},
                       {"word", part.word},
                       {"title", part.title},
                       {"blocks", std::move(blocks)}});
    }
    sections.push_back({{"id", section.id},
                        {"title", section.title},
                        {"kind", kind_name(section.kind)},
                        {"parts", std::move(parts)}});
  }
  const Json json = {{"schema", "dynid.report/1"}, {"kind", document.kind},
                     {"title", document.title},    {"subtitle", document.subtitle},
                     {"state", document.state},    {"state_text", document.state_text},
                     {"origin", document.origin},  {"sections", std::move(sections)}};
  return for_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string report_page(const ReportDocument& document) {
  // from the end on, so that no text of a robot can hold the mark that is looked for next
  std::string page = page_template();
  put(page, "@REPORT@", document_json(document));
  put(page, "@TITLE@", for_element(document.title + ": " + document.kind));
  return page;
}

}  // namespace dyngen::runtime
