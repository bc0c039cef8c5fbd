// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/options/page_options.h"

namespace dyngen::runtime {

/// Writes a command's files and, where they are asked for, the page and its figures.
/// @param document  called if there is a page or a folder of figures
/// @return          what was made of the page: paths
/// @throws OutputError, FigureError
std::vector<std::string> write_with_page(const PageOptions& options,
                                         const std::function<ReportDocument()>& document,
                                         ProgressLine& progress, std::vector<OutputFile> files);

/// Prints "written: a, b" where there is something.
void tell_written(const std::vector<std::string>& paths);

}  // namespace dyngen::runtime
