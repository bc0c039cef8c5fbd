// SPDX-License-Identifier: MIT
#include "runtime/report/document.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

/// Calls visit(block) for every block of the document.
template <class Visit>
void each_block(const ReportDocument& document, const Visit& visit) {
  for (const ReportSection& section : document.sections) {
    for (const ReportPart& part : section.parts) {
      for (const ReportBlock& block : part.blocks) visit(block);
    }
  }
}

/// All blocks of one kind.
template <class Block>
std::vector<const Block*> blocks_of(const ReportDocument& document) {
  std::vector<const Block*> all;
  each_block(document, [&](const ReportBlock& block) {
    if (const auto* own = std::get_if<Block>(&block)) all.push_back(own);
  });
  return all;
}

void check_id(const std::string& id, std::set<std::string>& seen) {
  const bool good =
      !id.empty() && id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == id.npos;
  if (!good) {
    throw std::invalid_argument(
        fmt::format("ReportDocument: id '{}', expected letters a to z, digits and '-'", id));
  }
  if (!seen.insert(id).second) {
    throw std::invalid_argument(fmt::format("ReportDocument: id '{}' is used twice", id));
  }
}

void check_length(const std::string& chart, const char* what, Index found, Index expected) {
  if (found == expected) return;
  throw std::invalid_argument(fmt::format(
      "ReportDocument: chart '{}' has {} values of {}, expected {}", chart, found, what, expected));
}

void check_panel(const std::string& chart, const ReportPanel& panel) {
  const Index n = panel.x.size();
  for (Index i = 1; i < n; ++i) {
    if (panel.x[i] > panel.x[i - 1]) continue;
    throw std::invalid_argument(
        fmt::format("ReportDocument: x of chart '{}' does not ascend at {}", chart, i));
  }
  for (const ReportSeries& series : panel.series) {
    check_length(chart, "y", series.y.size(), n);
    check_length(chart, "high", series.high.size(), series.low.size());
    if (series.low.size() != 0) check_length(chart, "low", series.low.size(), n);
  }
  for (const ReportCloud& cloud : panel.clouds) {
    check_length(chart, "y of a cloud", cloud.y.size(), cloud.x.size());
  }
}

}  // namespace

const char* role_name(Role role) {
  switch (role) {
    case Role::kModel:
      return "model";
    case Role::kBefore:
      return "before";
    case Role::kAfter:
      return "after";
    case Role::kFloor:
      return "floor";
    case Role::kForward:
      return "forward";
    case Role::kBackward:
      return "backward";
    case Role::kData:
      break;
  }
  return "data";
}

void ReportDocument::validate() const {
  std::set<std::string> ids;
  for (const ReportSection& section : sections) {
    check_id(section.id, ids);
    for (const ReportPart& part : section.parts) {
      if (!part.id.empty()) check_id(part.id, ids);
    }
  }
  for (const ReportBars* bars : bars_of(*this)) check_id(bars->id, ids);
  for (const ReportMatrix* matrix : matrices_of(*this)) {
    check_id(matrix->id, ids);
    const auto size = static_cast<Index>(matrix->names.size());
    if (matrix->values.rows() == size && matrix->values.cols() == size) continue;
    throw std::invalid_argument(
        fmt::format("ReportDocument: matrix '{}' is {} x {}, but has {} names", matrix->id,
                    matrix->values.rows(), matrix->values.cols(), size));
  }
  std::set<std::string> with_views;
  for (const ReportChart* chart : charts_of(*this)) {
    if (!chart->views.empty()) with_views.insert(chart->id);
  }
  for (const ReportChart* chart : charts_of(*this)) {
    check_id(chart->id, ids);
    if (chart->views.empty() && !with_views.contains(chart->same_as)) {
      throw std::invalid_argument(fmt::format(
          "ReportDocument: chart '{}' has no views, nor has '{}'", chart->id, chart->same_as));
    }
    for (const ReportView& view : chart->views) {
      for (const ReportPanel& panel : view.panels) check_panel(chart->id, panel);
    }
  }
  each_block(*this, [](const ReportBlock& block) {
    const auto* table = std::get_if<ReportTable>(&block);
    if (table == nullptr) return;
    for (const auto& row : table->rows) {
      if (row.size() == table->header.size()) continue;
      throw std::invalid_argument(fmt::format("ReportDocument: a row has {} cells, its header {}",
                                              row.size(), table->header.size()));
    }
  });
}

std::vector<const ReportChart*> charts_of(const ReportDocument& document) {
  return blocks_of<ReportChart>(document);
}

std::vector<const ReportBars*> bars_of(const ReportDocument& document) {
  return blocks_of<ReportBars>(document);
}

std::vector<const ReportMatrix*> matrices_of(const ReportDocument& document) {
  return blocks_of<ReportMatrix>(document);
}

}  // namespace dyngen::runtime
