// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/message_log.h"

namespace dyngen::runtime {

/// The messages of a ROS 1 bag, version 2.0 (wiki.ros.org/Bags/Format/2.0), record by record, in
/// the order of the file: an index is not needed, and memory is that of the largest chunk.
/// @throws LogError
std::unique_ptr<MessageSource> open_rosbag1(const LogBytes& bytes);

}  // namespace dyngen::runtime
