// SPDX-License-Identifier: MIT
// Any bytes are either a robot file or a ModelError whose every message has its place; nothing else
// may happen.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "gen/robot_file/robot_file.h"

namespace {

constexpr std::string_view kFileName = "fuzz.robot";

[[noreturn]] void fail(const char* claim, std::string_view detail) {
  std::fprintf(stderr, "violated: %s\n%.*s\n", claim, static_cast<int>(detail.size()),
               detail.data());
  std::abort();
}

/// Takes digits and a ':' from the front; false if they are not there.
bool take_number(std::string_view& text) {
  const std::size_t digits = text.find_first_not_of("0123456789");
  if (digits == 0 || digits == text.npos || text[0] == '0' || text[digits] != ':') return false;
  text.remove_prefix(digits + 1);
  return true;
}

/// `fuzz.robot:LINE:COLUMN: error: ...`, or `fuzz.robot: N more errors left out`
bool is_placed(std::string_view line) {
  if (line.find(" left out") != line.npos && line.find("error:") == line.npos) return true;
  line.remove_prefix(kFileName.size());
  if (line.empty() || line.front() != ':') return false;
  line.remove_prefix(1);
  if (!take_number(line) || !take_number(line)) return false;
  return line.starts_with(" error: ") || line.starts_with(" warning: ");
}

void check_message(std::string_view message) {
  if (message.find(": error: ") == message.npos) fail("a ModelError has an error", message);
  while (!message.empty()) {
    const std::size_t end = message.find('\n');
    if (end == message.npos) fail("every line of a message ends", message);
    const std::string_view line = message.substr(0, end);
    if (line.starts_with(kFileName)) {
      if (!is_placed(line)) fail("every message has line and column", line);
    } else if (line.find(" | ") == line.npos) {
      fail("every other line is an excerpt", line);
    }
    message.remove_prefix(end + 1);
  }
}

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
    const bool scalar = i >= static_cast<std::size_t>(dyngen::RowKey::kGx);
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
    check_message(error.what());
  }
  return 0;
}
