// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/page/page_output.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <system_error>

#include "runtime/report/document_json.h"
#include "runtime/report/figures.h"

namespace dyngen::runtime {
namespace {

/// Files of the folder --figures: numbers at once, pictures as gnuplot draws them.
void write_figures(const std::string& folder, const ReportDocument& document,
                   ProgressLine& progress) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("{}: {}", folder, error.message()));
  const std::vector<ReportFigure> figures = report_figures(document);
  std::vector<OutputFile> numbers;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    progress.show("figures", i, figures.size());
    const std::string path = (std::filesystem::path(folder) / figures[i].name).string();
    numbers.push_back({path + ".csv", figures[i].csv});
    for (const char* ending : {".svg", ".png"}) draw(figures[i], path + ending);
  }
  write_files(numbers);
}

}  // namespace

std::vector<std::string> write_with_page(const PageOptions& options,
                                         const std::function<ReportDocument()>& document,
                                         ProgressLine& progress, std::vector<OutputFile> files) {
  std::vector<std::string> made;
  std::optional<ReportDocument> page;
  if (!options.report.empty() || !options.figures.empty()) page = document();
  if (!options.report.empty()) {
    files.push_back({options.report, report_page(*page)});
    made.push_back(options.report);
  }
  write_files(files);
  if (!options.figures.empty()) {  // last: a picture that cannot be drawn costs no answer
    write_figures(options.figures, *page, progress);
    made.push_back(options.figures);
  }
  progress.clear();
  return made;
}

void tell_written(const std::vector<std::string>& paths) {
  if (!paths.empty()) std::cout << fmt::format("written: {}\n", fmt::join(paths, ", "));
}

}  // namespace dyngen::runtime
