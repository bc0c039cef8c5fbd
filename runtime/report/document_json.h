// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/report/document.h"

namespace dyngen::runtime {

// Only in a build with nlohmann-json.

/// The document as the page reads it, schema dynid.report/1, in one line. Numbers have five digits;
/// what is not finite is null. It may stand in a <script> element: `<`, `>`, `&`, U+2028 and U+2029
/// are written \u003c and so on, and what is not UTF-8 is replaced.
/// @throws std::invalid_argument  as ReportDocument::validate()
std::string document_json(const ReportDocument& document);

/// The page: one file that needs no other and no network.
/// @throws std::invalid_argument  as ReportDocument::validate()
std::string report_page(const ReportDocument& document);

/// The page without a document; it becomes part of the program when that is built.
const std::string& page_template();

}  // namespace dyngen::runtime
