// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "runtime/plots/figure.h"
#include "runtime/report/document.h"

namespace dyngen::runtime {

/// A chart, bars or a matrix of a document for a paper.
struct ReportFigure {
  std::string name;  ///< of its files, without ending
  std::variant<Figure, HeatMap> picture;
  std::string csv;  ///< its numbers: a row a value, columns view, panel, series, x, y, low, high
};

/// All charts, bars and matrices of a document; the first view of a chart is drawn, the CSV has
/// all. A matrix has the columns row, column, value.
std::vector<ReportFigure> report_figures(const ReportDocument& document);

/// @throws FigureError, as draw() of its picture
void draw(const ReportFigure& figure, const std::string& path);

}  // namespace dyngen::runtime
