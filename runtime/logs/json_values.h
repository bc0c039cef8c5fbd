// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "runtime/logs/message_readers.h"

namespace dyngen::runtime {

/// Reads objects of JSON, one a message: "a.b" for fields within fields, "a[1]" for elements of
/// arrays; true is 1, false 0; null and NaN are no values; texts that hold a number or a time are
/// read. @throws std::runtime_error if this library was built without nlohmann-json
std::unique_ptr<MessageReader> json_message_reader();

/// The same text, with "null" for NaN and the infinities, which JSON does not have but programs
/// write.
std::string plain_json(std::string_view text);

}  // namespace dyngen::runtime
