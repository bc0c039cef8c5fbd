# Writes OUTPUT, a C++ file with the text of the report's page, PAGE, in it.
# Called by the build: cmake -DOUTPUT=... -DPAGE=report.html -P EmbedReport.cmake
file(READ "${PAGE}" text)
string(FIND "${text}" ")page\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "${PAGE} holds the end of a raw string: )page\"")
endif()
set(content "// SPDX-License-Identifier: MIT
// Made from generated/report/report.html by the build.
#include \"runtime/report/document_json.h\"

namespace dyngen::runtime {

const std::string& page_template() {
  static const std::string kPage = R\"page(${text})page\";
  return kPage;
}

}  // namespace dyngen::runtime
")
file(WRITE "${OUTPUT}.new" "${content}")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
