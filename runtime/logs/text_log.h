// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "runtime/logs/raw_log.h"
#include "runtime/recordings/byte_source.h"

namespace dyngen::runtime {

/// Rows of text: docs/reference/logs.md says what is understood. Memory is bounded by the longest
/// line.
///
/// @param name  of the file, for messages
/// @throws LogError
std::unique_ptr<RawLog> open_text_log(ByteSource source, const std::string& name,
                                      const LogTextSettings& settings);

}  // namespace dyngen::runtime
