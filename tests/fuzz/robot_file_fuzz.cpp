// SPDX-License-Identifier: MIT
// Any bytes are either a robot file or a ModelError whose every message has its place; nothing else
// may happen.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "gen/robot_file/robot_file.h"
#include "tests/fuzz/placed_messages.h"

namespace {

constexpr std::string_view kFileName = "fuzz.robot";

using dyngen::test::check_message;
using dyngen::test::fail;

void check_value(const dyngen::FieldValue& value) {
  if (value.unknown) return;
  const GiNaC::ex number = value.value.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(number)) fail("a value is a number", value.text);
  if (!GiNaC::ex_to<GiNaC::numeric>(number).is_real()) fail("a value is real", value.text);
  if (!std::isfinite(GiNaC::ex_to<GiNaC::numeric>(number).to_double())) {
    fail("a value is finite", value.text);
  }
}

void check_file(const dyngen::RobotFile& file) {
  const auto joints = static_cast<std::size_t>(file.joint_count);
  if (file.joint_count < 1 || file.joint_count > dyngen::kMaxJoints) fail("joints in range", "");
  for (std::size_t i = 0; i < dyngen::kRowKeyCount; ++i) {
    const dyngen::Row& row = file.rows[i];
    const bool scalar = i >= static_cast<std::size_t>(dyngen::RowKey::kGx) &&
                        i <= static_cast<std::size_t>(dyngen::RowKey::kGz);
    const std::size_t expected = !row.present ? 0 : scalar ? 1 : joints;
    if (row.values.size() != expected) fail("a row has its number of values", "");
    for (const dyngen::FieldValue& value : row.values) check_value(value);
  }
  for (const dyngen::EffectRow& effect : file.effects) {
    for (const auto& setting : effect.settings) check_value(setting.value);
  }
  if (!file.joint_names.empty() && file.joint_names.size() != joints) fail("joint names", "");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const dyngen::RobotFile file = dyngen::parse_robot_file(text, std::string(kFileName));
    if (file.text != text) fail("the text is kept", file.text);
    check_file(file);
  } catch (const dyngen::ModelError& error) {
    check_message(error.what(), kFileName);
  }
  return 0;
}
