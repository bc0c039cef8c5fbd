// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/robot_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/diagnostic/line_table.h"
#include "gen/robot_file/cad_rows.h"
#include "gen/robot_file/row_reader.h"
#include "gen/robot_file/value_checks.h"

namespace dyngen {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20U;  // a robot file has kilobytes

/// The place of byte `offset` in a text that may be no text at all.
SourcePosition position_of(std::string_view text, std::size_t offset) {
  return LineTable(text).position_of(text, offset);
}

/// Reports bytes on which reading row by row would make no sense.
void check_is_text(std::string_view text, Diagnostics& diagnostics) {
  const std::size_t nul = text.find('\0');
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    diagnostics.error(position_of(text, 0), 1, "this text is UTF-16", "save the file as UTF-8");
    return;
  }
  if (nul != text.npos) {
    diagnostics.error(position_of(text, nul), 1,
                      "NUL byte: this is a binary file, not a robot file",
                      "a robot file is plain text, not UTF-16");
    return;
  }
  for (std::size_t i = text.find('\r'); i != text.npos; i = text.find('\r', i + 1)) {
    if (i + 1 < text.size() && text[i + 1] == '\n') continue;
    diagnostics.error(position_of(text, i), 1, "carriage return without a line feed",
                      "save the file with Unix (LF) or Windows (CR LF) line ends");
    return;
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '<') {
    diagnostics.error(position_of(text, first), 1, "this is XML, not a robot file",
                      "URDF and MJCF are read where a robot is given by its file's path");
    return;
  }
  if (first == text.npos) {
    diagnostics.error({1, 1}, 1, text.empty() ? "the file is empty" : "the file holds only blanks",
                      "a robot file begins with: number_link 6");
  }
}

void throw_if_errors(const Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

[[noreturn]] void throw_unreadable(const std::string& path, const std::string& reason) {
  Diagnostics diagnostics(path, "");
  diagnostics.error({}, 1, "cannot read: " + reason);
  throw ModelError(diagnostics.render());
}

}  // namespace

RobotFile parse_robot_file(std::string text, std::string file_name, const FurtherCheck& further) {
  Diagnostics diagnostics(file_name, text);
  check_is_text(text, diagnostics);
  throw_if_errors(diagnostics);
  RobotFile file = read_rows(std::move(text), std::move(file_name), diagnostics);
  resolve_cad_rows(file, diagnostics);
  check_values(file, diagnostics);
  if (further) further(file, diagnostics);
  throw_if_errors(diagnostics);
  file.warnings = diagnostics.all();
  return file;
}

namespace {

/// An effect of a joint comes from where the joint's friction does.
void move_effect(EffectRow& effect, const MadeText& made) {
  std::size_t column = 0;
  for (const EffectRow::Setting& setting : effect.settings) {
    if (setting.key != "joint" || setting.value.unknown) continue;
    column =
        static_cast<std::size_t>(GiNaC::ex_to<GiNaC::numeric>(setting.value.value).to_int() - 1);
  }
  const MadeText::Place place = made.place(RowKey::kFs, column);
  effect.position = place.position;
  for (EffectRow::Setting& setting : effect.settings) {
    setting.position = setting.value.position = place.position;
    setting.value.length = place.length;
  }
}

}  // namespace

RobotFile parse_made_robot_file(MadeText made, std::string file_name, const FurtherCheck& further) {
  Diagnostics text_diagnostics(file_name, made.text);
  RobotFile file = read_rows(std::move(made.text), std::move(file_name), text_diagnostics);
  resolve_cad_rows(file, text_diagnostics);
  DYNGEN_ASSERT(!text_diagnostics.has_errors(),
                "a robot file that was made cannot be read:\n" + text_diagnostics.render());
  file.source_text = std::move(made.source_text);
  file.made_of = std::move(made.made_of);
  for (std::size_t key = 0; key < kRowKeyCount; ++key) {
    Row& row = file.rows[key];
    for (std::size_t column = 0; column < row.values.size(); ++column) {
      const MadeText::Place place = made.place(static_cast<RowKey>(key), column);
      row.values[column].position = place.position;
      row.values[column].length = place.length;
    }
    row.keyword = made.place(static_cast<RowKey>(key), row.values.size()).position;
  }
  for (EffectRow& effect : file.effects) move_effect(effect, made);
  file.last_word = made.place(RowKey::kSigma, static_cast<std::size_t>(file.joint_count)).position;
  Diagnostics found(file.file_name, file.source_text);
  check_values(file, found);
  if (further) further(file, found);
  Diagnostics diagnostics(file.file_name, file.source_text);
  for (const Diagnostic& own : made.warnings) {
    diagnostics.warning(own.position, own.length, own.message, own.hint);
  }
  for (const Diagnostic& own : found.all()) {
    const std::string message = "in the robot file made of this, " + own.message;
    if (own.severity == Severity::kError) {
      diagnostics.error(own.position, own.length, message, own.hint);
    } else {
      diagnostics.warning(own.position, own.length, message, own.hint);
    }
  }
  throw_if_errors(diagnostics);
  file.warnings = diagnostics.all();
  return file;
}

std::string read_description(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw_unreadable(path, std::make_error_code(std::errc::is_a_directory).message());
  }
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw_unreadable(path, std::generic_category().message(errno));
  std::string bytes;
  std::string block(std::size_t{1} << 16U, '\0');
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    bytes.append(block, 0, count);
    if (bytes.size() > kMaxBytes)
      throw_unreadable(path, "larger than 16 MiB: no description of a robot");
  }
  if (std::ferror(file.get()) != 0) {
    throw_unreadable(path, std::generic_category().message(errno));
  }
  return bytes;
}

}  // namespace dyngen
