// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/plots/figure.h"
#include "runtime/report/document.h"

namespace dyngen::runtime {

/// A chart of a document for a paper.
struct ReportFigure {
  std::string name;  ///< of its files, without ending
  Figure figure;
  std::string csv;  ///< its numbers: a row a value, columns view, panel, series, x, y, low, high
};

/// All charts and bars of a document in its order; the first view of each is drawn, the CSV has
/// all.
std::vector<ReportFigure> report_figures(const ReportDocument& document);

}  // namespace dyngen::runtime
