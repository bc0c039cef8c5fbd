// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "runtime/logs/log_bytes.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// The numbers of an HDF5 file: datasets of one or two dimensions, read piece by piece. Datasets of
/// a group of the first level are one table for each length, columns named by their path within it
/// ("joint1/position", "q[2]"); a dataset of compound elements is a table with a column for each
/// member. Units are those of the attributes "units", "unit" or "Units".
/// @throws LogError; also if this library was built without HDF5
std::unique_ptr<RawLog> open_hdf5(const LogBytes& bytes);

}  // namespace dyngen::runtime
