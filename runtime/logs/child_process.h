// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace dyngen::runtime {

/// Does something first in a child process, whose memory and time are bounded. Libraries of some
/// formats stop the program at damaged files, or take all its memory; here the child stops, and
/// that is told.
///
/// @param file   for messages
/// @param bytes  of the file: more take more time
/// @param work   reads all of it; what it throws is thrown again as LogError
/// @throws LogError if the child fails
void try_in_child(const std::string& file, std::uint64_t bytes, const std::function<void()>& work);

}  // namespace dyngen::runtime
