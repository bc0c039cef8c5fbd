// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Judges of what dynid diagnose writes, made from the documents alone.
namespace dyngen::test {

/// What does not fit the schema dynid.diagnosis/1 of docs/reference/diagnosis.md, a line each: keys
/// that are missing or unknown, values of the wrong kind.
std::vector<std::string> schema_faults(const nlohmann::json& json);

/// Places of all keys of all objects.
std::vector<nlohmann::json::json_pointer> all_keys(const nlohmann::json& json);

/// The document in a page; null where there is none that can be read.
nlohmann::json page_document(const std::string& page);

/// What is wrong with a page: it is not the template with a document and a title in their places,
/// or the document could end its element. Empty: nothing.
std::string page_fault(const std::string& page);

}  // namespace dyngen::test
