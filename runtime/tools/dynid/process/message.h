// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::runtime {

/// What processes say to each other: a word and what belongs to it, any bytes.
using Message = std::vector<std::string>;

std::string packed(const Message& message);
/// @throws std::runtime_error  if these are not the bytes of a message
Message unpacked(const std::string& bytes);

}  // namespace dyngen::runtime
