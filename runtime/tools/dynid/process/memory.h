// SPDX-License-Identifier: MIT
#pragma once

namespace dyngen::runtime {

/// From here on the C library keeps what matrices of less than 16 MiB leave for the next ones,
/// instead of giving it back to the system and having it cleared again: 5 to 15 % of the processor
/// time of a diagnosis. Does nothing where the C library is not glibc.
void keep_memory();

}  // namespace dyngen::runtime
