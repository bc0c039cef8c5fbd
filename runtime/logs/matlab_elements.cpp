// SPDX-License-Identifier: MIT
#include "runtime/logs/matlab_elements.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "runtime/logs/matlab_structure.h"
#include "runtime/logs/unpacking.h"

namespace dyngen::runtime {
namespace {

// MAT-File Format, R2024b: level 5
constexpr std::size_t kMatlabHeader = 128, kMatlabVersionAt = 124, kMatlabOrderAt = 126;
constexpr std::uint32_t kMatlabMatrix = 14, kMatlabCompressed = 15;
constexpr std::uint64_t kMatlabTag = 8;

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size, bool big) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big ? i : size - 1 - i)]);
  }
  return value;
}

/// The variable within a packed element.
void check_packed(const std::string& packed, bool big) {
  if (!unpacks_zlib()) return;
  const std::string element = unpacked("zlib", packed, kMostUnpacked);
  if (element.size() < kMatlabTag || number_at(element, 0, 4, big) != kMatlabMatrix ||
      number_at(element, 4, 4, big) > element.size() - kMatlabTag) {
    throw std::runtime_error("found a packed variable that is none");
  }
  const auto size = static_cast<std::size_t>(number_at(element, 4, 4, big));
  check_matlab_matrix(std::string_view(element).substr(kMatlabTag, size), big);
}

}  // namespace

std::size_t check_matlab_elements(const LogBytes& bytes) {
  BinaryReader file(bytes);
  std::string head;
  file.read(head, kMatlabHeader, "the header of a MATLAB file");
  const std::string order = head.substr(kMatlabOrderAt, 2);
  if (order != "IM" && order != "MI") {
    file.fail(kMatlabOrderAt, "found a MATLAB file that does not say in which order its bytes are");
  }
  const bool big = order == "MI";
  const std::uint64_t version = number_at(head, kMatlabVersionAt, 2, big);
  constexpr std::uint64_t kVersion5 = 0x0100, kVersion73 = 0x0200;
  if (version == kVersion73) return 0;
  if (version != kVersion5) {
    file.fail(kMatlabVersionAt, fmt::format("found version {:#06x}, expected 0x0100 or 0x0200 "
                                            "(MATLAB 5 to 7.3)",
                                            version));
  }
  std::size_t variables = 0;
  while (file.left() > 0) {
    const std::uint64_t begin = file.place();
    file.read(head, kMatlabTag, "a variable");
    const std::uint64_t type = number_at(head, 0, 4, big), size = number_at(head, 4, 4, big);
    if (type != kMatlabMatrix && type != kMatlabCompressed) {
      file.fail(begin,
                fmt::format("found an element of type {}, expected a variable (14 or 15)", type));
    }
    if (size > file.left()) {
      file.fail(begin,
                fmt::format("found {} bytes to the end of the file, expected a variable of {}: "
                            "the file is truncated",
                            file.left(), size));
    }
    std::string element;
    file.read(element, size, "a variable");
    try {
      if (type == kMatlabCompressed) {
        check_packed(element, big);
      } else {
        check_matlab_matrix(element, big);
      }
    } catch (const std::runtime_error& error) {
      file.fail(begin, error.what());
    }
    ++variables;
  }
  return variables;
}

}  // namespace dyngen::runtime
