// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "runtime/logs/raw_log.h"
#include "runtime/recordings/byte_source.h"

namespace dyngen::runtime {

/// JSON lines, or one document, told by the second line. docs/reference/logs.md says what becomes
/// what.
///
/// @param open  opens the bytes, from their beginning, each time it is called
/// @throws LogError with line or byte
std::unique_ptr<RawLog> open_json_log(const std::function<ByteSource()>& open,
                                      const std::string& name);

}  // namespace dyngen::runtime
