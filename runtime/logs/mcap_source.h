// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/message_log.h"

namespace dyngen::runtime {

/// The messages of an MCAP file (mcap.dev/spec, version 0), record by record: memory is that of the
/// largest chunk. Checks of chunks are verified. @throws LogError
std::unique_ptr<MessageSource> open_mcap(const LogBytes& bytes);

}  // namespace dyngen::runtime
