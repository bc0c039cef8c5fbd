// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

/// A number within an element of an array.
struct NumpyField {
  std::string name;        ///< of a structured type, "a.b" if it is nested; empty: a plain one
  std::size_t offset = 0;  ///< in the element, bytes
  std::size_t count = 1;   ///< of a subarray
  char kind = 'f';         ///< f: float, i: signed, u: unsigned, b: bool, M: time, m: duration
  std::size_t size = 8;    ///< bytes
  bool big_endian = false;
  std::int64_t per_second = 0;    ///< of M and m; 0: its unit is longer than a second
  std::int64_t seconds_each = 1;  ///< of M and m with such a unit
};

/// What stands before the data of a .npy file.
struct NumpyHeader {
  std::vector<NumpyField> fields;
  std::vector<std::string> left_out;  ///< fields that are no real numbers, with their type
  std::size_t element_bytes = 0;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t data_begin = 0;  ///< bytes before the data
};

/// Bytes of a .npy file that are needed to know how long its header is.
inline constexpr std::size_t kNumpyPreamble = 12;

/// Bytes before the data. @throws std::runtime_error, a sentence
std::size_t numpy_data_begin(std::string_view preamble);

/// Reads the text of the header (NEP 1, versions 1.0 to 3.0).
/// @param begin  the file's bytes before the data
/// @throws std::runtime_error, a sentence: it is none, or an element is a Python object
NumpyHeader read_numpy_header(std::string_view begin);

}  // namespace dyngen::runtime
