// SPDX-License-Identifier: MIT
#include "runtime/logs/matlab_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace dyngen::runtime {
namespace {

// MAT-File Format, R2024b, tables 1-1 and 1-3
constexpr std::uint32_t kMatrixType = 14;
constexpr std::uint32_t kCellClass = 1, kStructClass = 2, kObjectClass = 3;
constexpr std::uint32_t kFirstNumberClass = 6, kLastNumberClass = 15;
constexpr std::uint32_t kComplexFlag = 0x0800;
constexpr std::size_t kDeepestMatrix = 32, kTagBytes = 8;
/// Bytes of a number, by the type of its element; 0: no numbers.
constexpr std::array<std::size_t, 14> kNumberBytes = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};

struct MatlabElement {
  std::uint32_t type = 0;
  std::string_view data;
};

class StructureWalk {
 public:
  explicit StructureWalk(bool big) : big_(big) {}

  void matrix(std::string_view rest, std::size_t depth);

 private:
  [[nodiscard]] std::uint32_t word(std::string_view bytes, std::size_t at) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8 | static_cast<unsigned char>(bytes[at + (big_ ? i : 3 - i)]);
    }
    return value;
  }
  MatlabElement next(std::string_view& rest) const;
  void numbers(std::string_view& rest, std::uint64_t count, const std::string& name) const;
  void members(std::string_view& rest, std::uint64_t count, const std::string& name,
               std::size_t depth);

  bool big_;
};

MatlabElement StructureWalk::next(std::string_view& rest) const {
  if (rest.size() < kTagBytes)
    throw std::runtime_error("found the end of a variable, expected more");
  const std::uint32_t first = word(rest, 0);
  if (first >> 16 != 0) {  // up to four bytes, within the tag
    const std::uint32_t size = first >> 16;
    if (size > 4) throw std::runtime_error(fmt::format("found a small element of {} bytes", size));
    const MatlabElement element{first & 0xFFFF, rest.substr(4, size)};
    rest.remove_prefix(kTagBytes);
    return element;
  }
  const std::uint64_t size = word(rest, 4);
  if (size > rest.size() - kTagBytes) {
    throw std::runtime_error(fmt::format("found an element of {} bytes, expected {} at most", size,
                                         rest.size() - kTagBytes));
  }
  const MatlabElement element{first, rest.substr(kTagBytes, static_cast<std::size_t>(size))};
  const std::uint64_t padded = kTagBytes + (size + 7) / 8 * 8;
  rest.remove_prefix(static_cast<std::size_t>(std::min<std::uint64_t>(padded, rest.size())));
  return element;
}

void StructureWalk::numbers(std::string_view& rest, std::uint64_t count,
                            const std::string& name) const {
  const MatlabElement element = next(rest);
  const std::size_t bytes = element.type < kNumberBytes.size() ? kNumberBytes[element.type] : 0;
  if (bytes == 0) {
    throw std::runtime_error(
        fmt::format("found data of type {} in '{}', expected numbers", element.type, name));
  }
  if (element.data.size() / bytes != count) {
    throw std::runtime_error(fmt::format("found {} numbers in '{}', expected {}",
                                         element.data.size() / bytes, name, count));
  }
}

void StructureWalk::members(std::string_view& rest, std::uint64_t count, const std::string& name,
                            std::size_t depth) {
  if (count > rest.size() / kTagBytes) {
    throw std::runtime_error(
        fmt::format("found {} bytes in '{}', expected {} elements", rest.size(), name, count));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const MatlabElement member = next(rest);
    if (member.type != kMatrixType) {
      throw std::runtime_error(
          fmt::format("found an element of type {} in '{}', expected 14", member.type, name));
    }
    matrix(member.data, depth + 1);
  }
}

void StructureWalk::matrix(std::string_view rest, std::size_t depth) {
  if (rest.empty()) return;
  if (depth > kDeepestMatrix) {
    throw std::runtime_error(
        fmt::format("found variables nested more than {} deep", kDeepestMatrix));
  }
  const MatlabElement flags = next(rest);
  if (flags.data.size() < 8) throw std::runtime_error("found a variable without its class");
  const std::uint32_t kind = word(flags.data, 0) & 0xFF;
  const bool is_complex = (word(flags.data, 0) & kComplexFlag) != 0;
  const bool has_sides = kind >= kCellClass && kind <= kLastNumberClass;
  if (!has_sides) return;  // functions and objects of later versions are left out
  const MatlabElement sides = next(rest);
  std::uint64_t count = 1;
  for (std::size_t at = 0; at + 4 <= sides.data.size(); at += 4) {
    const std::uint64_t side = word(sides.data, at);
    constexpr std::uint64_t kMostNumbers = std::uint64_t{1} << 40;
    if (side != 0 && count > kMostNumbers / side) {
      throw std::runtime_error("found sides of an array that no file holds");
    }
    count *= side;
  }
  if (sides.data.size() < 8) throw std::runtime_error("found a variable without its sides");
  const std::string name(next(rest).data);
  if (kind >= kFirstNumberClass) {
    numbers(rest, count, name);
    if (is_complex) numbers(rest, count, name);
  } else if (kind == kCellClass) {
    members(rest, count, name, depth);
  } else if (kind == kStructClass || kind == kObjectClass) {
    if (kind == kObjectClass) next(rest);  // the name of its class
    const MatlabElement length = next(rest);
    const std::uint32_t bytes = length.data.size() >= 4 ? word(length.data, 0) : 0;
    const MatlabElement names = next(rest);
    const std::uint64_t fields = bytes == 0 ? 0 : names.data.size() / bytes;
    if (fields != 0 && count > (std::uint64_t{1} << 40) / fields) {
      throw std::runtime_error("found sides of a struct that no file holds");
    }
    members(rest, count * fields, name, depth);
  }
}

}  // namespace

void check_matlab_matrix(std::string_view matrix, bool big) {
  StructureWalk(big).matrix(matrix, 0);
}

}  // namespace dyngen::runtime
