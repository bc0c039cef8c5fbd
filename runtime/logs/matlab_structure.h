// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace dyngen::runtime {

/// Goes through a variable of a MATLAB 5 file: every array must have as many numbers as its sides
/// say, every struct and cell array as many elements.
///
/// @param matrix  the bytes of an element of type 14 (miMATRIX), without its tag
/// @param big     they are big-endian
/// @throws std::runtime_error, a sentence
void check_matlab_matrix(std::string_view matrix, bool big);

}  // namespace dyngen::runtime
