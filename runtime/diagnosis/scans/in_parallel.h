// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace dyngen::runtime {

/// How many threads work at once: as many as there are processors, four at most, since each holds
/// signals of its own.
std::size_t working_threads();

/// Pieces 0 .. count - 1 of work, each done once by one of some threads, of which the caller is
/// thread 0. Returns when all are done.
/// @param progress  told the part that is begun, 0 .. 1, from the calling thread; may be empty
/// @throws what the work throws first
void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t piece, std::size_t thread)>& work,
                 const std::function<void(double begun)>& progress = {});

}  // namespace dyngen::runtime
