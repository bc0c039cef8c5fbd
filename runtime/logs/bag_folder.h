// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "runtime/logs/message_log.h"

namespace dyngen::runtime {

/// The messages of a rosbag2 folder: of its files .db3 and .mcap, one after another, in the order
/// of its metadata.yaml, else of their names. @throws LogError
std::unique_ptr<MessageSource> open_bag_folder(const std::string& path);

}  // namespace dyngen::runtime
