// SPDX-License-Identifier: MIT
#include "runtime/report/figures.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Place of a role among the colours of the plots.
int colour_of(Role role) {
  switch (role) {
    case Role::kModel:
      return 1;  // vermilion
    case Role::kBefore:
      return 4;  // orange
    case Role::kAfter:
    case Role::kForward:
      return 0;  // blue
    case Role::kBackward:
      return 2;  // green
    case Role::kFloor:
      return 7;  // grey
    case Role::kData:
      break;
  }
  return 6;  // black
}

Panel panel_of(const ReportPanel& own, const std::string& title) {
  Panel panel;
  panel.title = title;
  panel.x_label = own.x_label;
  panel.y_label = own.y_label;
  for (const ReportCloud& cloud : own.clouds) {
    panel.series.push_back(
        {cloud.name, cloud.x, cloud.y, false, colour_of(cloud.role), SeriesStyle::kPoints, {}});
  }
  for (const ReportSeries& series : own.series) {
    const int colour = colour_of(series.role);
    if (series.low.size() != 0) {
      panel.series.push_back(
          {"", own.x, series.low, false, colour, SeriesStyle::kBand, series.high});
    }
    panel.series.push_back({series.name, own.x, series.y, series.dashed, colour});
  }
  return panel;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "";
}

double entry(const VectorXd& values, Index i) { return i < values.size() ? values[i] : NAN; }

std::string csv_of(const ReportChart& chart) {
  std::string text = "view,panel,series,x,y,low,high\n";
  for (const ReportView& view : chart.views) {
    for (const ReportPanel& panel : view.panels) {
      const std::string place = quoted(view.name) + "," + quoted(panel.y_label) + ",";
      for (const ReportSeries& series : panel.series) {
        for (Index i = 0; i < panel.x.size(); ++i) {
          text += fmt::format("{}{},{},{},{},{}\n", place, quoted(series.name), number(panel.x[i]),
                              number(series.y[i]), number(entry(series.low, i)),
                              number(entry(series.high, i)));
        }
      }
      for (const ReportCloud& cloud : panel.clouds) {
        const std::string name = quoted(fmt::format("samples {}", role_name(cloud.role)));
        for (Index i = 0; i < cloud.x.size(); ++i) {
          text +=
              fmt::format("{}{},{},{},,\n", place, name, number(cloud.x[i]), number(cloud.y[i]));
        }
      }
    }
  }
  return text;
}

ReportFigure figure_of(const ReportChart& chart) {
  Figure figure;
  figure.title = chart.title;
  figure.panel_height = chart.views.front().panels.size() > 1 ? 280 : 420;
  figure.panel_width = 900;
  for (const ReportPanel& panel : chart.views.front().panels) {
    figure.panels.push_back(panel_of(panel, ""));
  }
  return {chart.id, std::move(figure), csv_of(chart)};
}

ReportFigure figure_of(const ReportBars& bars) {
  std::string csv = "group,unit,bar,value\n";
  Panel panel;
  std::string unit;
  for (std::size_t g = 0; g < bars.groups.size(); ++g) {
    const ReportBarGroup& group = bars.groups[g];
    panel.x_names.push_back(group.label);
    unit = g == 0 || unit == group.unit ? group.unit : "unit of the joint";
    for (std::size_t b = 0; b < group.bars.size(); ++b) {
      const ReportBar& bar = group.bars[b];
      csv += fmt::format("{},{},{},{}\n", quoted(group.label), quoted(group.unit), quoted(bar.name),
                         number(bar.value));
      if (panel.series.size() <= b) {
        Series series{bar.name, {}, {}, false, colour_of(bar.role), SeriesStyle::kBars, {}};
        series.x = series.y = VectorXd::Constant(static_cast<Index>(bars.groups.size()), NAN);
        panel.series.push_back(std::move(series));
      }
      const auto place = static_cast<Index>(g);
      const double middle = (static_cast<double>(group.bars.size()) - 1) / 2;
      panel.series[b].x[place] = static_cast<double>(g) + 0.27 * (static_cast<double>(b) - middle);
      panel.series[b].y[place] = bar.value;
    }
  }
  panel.y_label = unit;
  Figure figure;
  figure.title = bars.title;
  figure.panel_width = 900;
  figure.panel_height = 360;
  figure.panels = {std::move(panel)};
  return {bars.id, std::move(figure), std::move(csv)};
}

ReportFigure figure_of(const ReportMatrix& matrix) {
  std::string csv = "row,column,value\n";
  for (std::size_t i = 0; i < matrix.names.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      csv += fmt::format("{},{},{}\n", quoted(matrix.names[i]), quoted(matrix.names[j]),
                         number(matrix.values(static_cast<Index>(i), static_cast<Index>(j))));
    }
  }
  return {matrix.id, HeatMap{matrix.title, matrix.names, matrix.values}, std::move(csv)};
}

}  // namespace

std::vector<ReportFigure> report_figures(const ReportDocument& document) {
  document.validate();
  std::vector<ReportFigure> figures;
  for (const ReportBars* bars : bars_of(document)) figures.push_back(figure_of(*bars));
  for (const ReportMatrix* matrix : matrices_of(document)) figures.push_back(figure_of(*matrix));
  for (const ReportChart* chart : charts_of(document)) {
    if (!chart->views.empty()) figures.push_back(figure_of(*chart));
  }
  return figures;
}

void draw(const ReportFigure& figure, const std::string& path) {
  std::visit([&](const auto& picture) { draw(picture, path); }, figure.picture);
}

}  // namespace dyngen::runtime
