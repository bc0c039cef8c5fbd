// SPDX-License-Identifier: MIT
// Any bytes are either a robot in one of the forms that are read or a ModelError whose every
// message has its place; nothing else may happen.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "gen/robot_input/robot_input.h"
#include "tests/fuzz/placed_messages.h"

namespace {

constexpr std::string_view kFileName = "fuzz.xml";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const dyngen::RobotFile file = dyngen::parse_robot(text, std::string(kFileName));
    if (file.source_text != text) dyngen::test::fail("the text is kept", file.source_text);
    if (file.joint_count < 1 || file.joint_count > dyngen::kMaxJoints) {
      dyngen::test::fail("joints in range", file.text);
    }
  } catch (const dyngen::ModelError& error) {
    dyngen::test::check_message(error.what(), kFileName);
  }
  return 0;
}
