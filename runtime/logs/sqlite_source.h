// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/message_log.h"

namespace dyngen::runtime {

/// The messages of a rosbag2 database (.db3), in the order in which they were written.
/// @throws LogError; also if this library was built without SQLite
std::unique_ptr<MessageSource> open_rosbag2_database(const LogBytes& bytes);

}  // namespace dyngen::runtime
