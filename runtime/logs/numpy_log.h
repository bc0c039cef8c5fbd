// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// One array (.npy), read piece by piece. @throws LogError
std::unique_ptr<RawLog> open_npy(const LogBytes& bytes);

/// Several arrays (.npz), stored or packed, of at most 1 GB in all.
/// @throws LogError; also if this library was built without libzip
std::unique_ptr<RawLog> open_npz(const LogBytes& bytes);

}  // namespace dyngen::runtime
