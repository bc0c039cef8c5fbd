// SPDX-License-Identifier: MIT
#pragma once

namespace dyngen::runtime {

/// From here on the C library keeps what large matrices leave for the next ones, instead of giving
/// it back to the system and having it cleared again: a quarter of the time of a diagnosis. Does
/// nothing where the C library is not glibc.
void keep_memory();

}  // namespace dyngen::runtime
