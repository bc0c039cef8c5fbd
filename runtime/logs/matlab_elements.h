// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "runtime/logs/log_bytes.h"

namespace dyngen::runtime {

/// Goes through the variables of a MATLAB 5 to 7 file: each must be whole, and as long as its sides
/// say. What is packed is looked at where this library was built with zlib.
///
/// @return the number of variables; 0 for version 7.3, which is HDF5
/// @throws LogError with the byte of the element
std::size_t check_matlab_elements(const LogBytes& bytes);

}  // namespace dyngen::runtime
