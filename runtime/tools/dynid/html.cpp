// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1c2126; --quiet: #5c6670; --line: #d6dbe0; --paper: #ffffff;
  --box: #f5f7f9; --before: #b5bec7; --after: #1f6fb2; --floor: #5c6670; --good: #1b7f4b; --bad: #b3261e; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e7ea; --quiet: #9aa4ae; --line: #39424b; --paper: #14181c; --box: #1d2329;
    --before: #56616b; --after: #5aa9e6; --floor: #9aa4ae; --good: #5fc98e; --bad: #ff8a80; } }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 62rem; background: var(--paper);
  color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .25rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .5rem; }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem; } p { margin: .4rem 0; max-width: 46rem; }
.quiet { color: var(--quiet); } .verdict { font-size: 1.15rem; border-left: .3rem solid var(--after);
  padding: .3rem 0 .3rem .9rem; } .finding { background: var(--box); border: 1px solid var(--line);
  border-radius: .5rem; padding: .2rem 1.1rem 1rem; margin: 1rem 0; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; margin: .5rem 0; font-size: .92rem; }
th, td { padding: .25rem .9rem .25rem 0; text-align: left; vertical-align: top;
  border-bottom: 1px solid var(--line); } th { color: var(--quiet); font-weight: 600; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
pre, code { font: .9rem/1.45 ui-monospace, monospace; } pre { background: var(--box);
  border: 1px solid var(--line); border-radius: .35rem; padding: .6rem .8rem; white-space: pre-wrap;
  overflow-wrap: anywhere; } ul { padding-left: 1.2rem; margin: .4rem 0; }
.finding pre { background: var(--paper); } .passed { color: var(--good); } .failed { color: var(--bad); }
svg { display: block; } .before { fill: var(--before); } .after { fill: var(--after); }
.floor { fill: var(--floor); } .key { display: inline-block; width: .8rem; height: .8rem;
  margin: 0 .35rem 0 .9rem; border-radius: .15rem; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; }
  .finding, tr { break-inside: avoid; } h2, h3 { break-after: avoid; }
  svg rect, .key { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)css";

}  // namespace

std::string html_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
    }
  }
  return escaped;
}

std::string html_paragraph(const std::string& text) {
  return text.empty() ? "" : "<p>" + html_text(text) + "</p>\n";
}

std::string html_list(const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string list = "<ul>\n";
  for (const std::string& line : lines) list += "<li>" + html_text(line) + "</li>\n";
  return list + "</ul>\n";
}

HtmlCell HtmlCell::of(double value) {
  return {std::isfinite(value) ? fmt::format("{:.4g}", value) : "-", true};
}

std::string html_table(const std::vector<std::string>& header,
                       const std::vector<std::vector<HtmlCell>>& rows) {
  std::string table = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const std::string& name : header) table += "<th>" + html_text(name) + "</th>";
  table += "</tr></thead>\n<tbody>\n";
  for (const std::vector<HtmlCell>& row : rows) {
    table += "<tr>";
    for (const HtmlCell& cell : row) {
      table += (cell.number ? "<td class=\"number\">" : "<td>") + cell.markup + "</td>";
    }
    table += "</tr>\n";
  }
  return table + "</tbody>\n</table></div>\n";
}

std::string html_bars(const std::vector<HtmlBar>& bars, const std::string& label) {
  constexpr double kWidth = 240, kThick = 7, kStep = 9;
  std::string picture = fmt::format(
      "<svg role=\"img\" aria-label=\"{}\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"0 0 {:.0f} "
      "{:.0f}\">",
      html_text(label), kWidth, kStep * static_cast<double>(bars.size()), kWidth,
      kStep * static_cast<double>(bars.size()));
  double y = 1;
  for (const HtmlBar& bar : bars) {
    const double length = std::isfinite(bar.length) ? std::clamp(bar.length, 0.0, 1.0) : 0;
    picture += fmt::format(
        "<rect class=\"{}\" x=\"0\" y=\"{:.0f}\" width=\"{:.1f}\" height=\"{:.0f}\" rx=\"1\"/>",
        bar.kind, y, kWidth * length, kThick);
    y += kStep;
  }
  return picture + "</svg>";
}

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      html_text(title), kStyle, body);
}

}  // namespace dyngen::runtime
