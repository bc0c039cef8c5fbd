// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/process/message.h"

#include <cstdint>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kLength = 8;  // bytes of a part's length, least significant first

}  // namespace

std::string packed(const Message& message) {
  std::string bytes;
  for (const std::string& part : message) {
    for (std::size_t i = 0; i < kLength; ++i) {
      bytes += static_cast<char>((static_cast<std::uint64_t>(part.size()) >> (8 * i)) & 0xFFU);
    }
    bytes += part;
  }
  return bytes;
}

Message unpacked(const std::string& bytes) {
  Message message;
  std::size_t place = 0;
  while (place < bytes.size()) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < kLength && place < bytes.size(); ++i) {
      length |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[place++])) << (8 * i);
    }
    if (length > bytes.size() - place) {
      throw std::runtime_error("a message between processes is cut off");
    }
    message.push_back(bytes.substr(place, length));
    place += length;
  }
  return message;
}

}  // namespace dyngen::runtime
