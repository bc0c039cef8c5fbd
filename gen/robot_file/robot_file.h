// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// The most joints that a robot file may declare.
inline constexpr int kMaxJoints = 100;

/// One value of a row: an exact number, or unknown ('*'), or none ('-').
struct FieldValue {
  bool unknown = false;  ///< there is no number
  GiNaC::ex value = 0;   ///< exact and real: rationals, pi, square roots, sin and cos of constants
  SourcePosition position;
  int length = 1;
  std::string text;  ///< as written
};

/// The rows with one value per joint (and gx, gy, gz with one value in all).
enum class RowKey {
  kSigma,
  kAl,
  kD,
  kTh,
  kR,
  kAnt,
  kXX,
  kXY,
  kXZ,
  kYY,
  kYZ,
  kZZ,
  kMX,
  kMY,
  kMZ,
  kM,
  kIA,
  kFs,
  kFv,
  kOff,
  kQmin,
  kQmax,
  kVmax,
  kAmax,
  kTaumax,
  kGx,
  kGy,
  kGz,
  // the CAD form of a body: centre of mass, moments about it, and the axes that these have. They
  // are read into the rows above, and are absent from a RobotFile.
  kCX,
  kCY,
  kCZ,
  kIXX,
  kIXY,
  kIXZ,
  kIYY,
  kIYZ,
  kIZZ,
  kIrX,
  kIrY,
  kIrZ,
};
inline constexpr std::size_t kRowKeyCount = 40;

/// A row of values; absent rows have present == false and no values.
struct Row {
  bool present = false;
  SourcePosition keyword;
  std::vector<FieldValue> values;
};

enum class DhConvention { kModified, kStandard };

/// What the numbers of the dynamic rows are.
enum class ParameterMeaning {
  kBodies,  ///< of the links and their rotors, each by itself
  kBase     ///< base parameters: sums of many bodies' parameters, each where one of them stands
};

/// What a keyword begins.
enum class Statement {
  kName,
  kNumberLink,
  kDh,
  kParameters,
  kLet,
  kValues,
  kJoints,
  kEffect,
  kStop
};

/// Where a row stands in the text: from its keyword to the end of its last word.
struct RowText {
  Statement statement = Statement::kValues;
  RowKey key = RowKey::kSigma;  ///< of Statement::kValues
  std::size_t begin = 0;        ///< bytes
  std::size_t end = 0;
};

/// `effect NAME key=value ...`, kept as written for the parts that know effects.
struct EffectRow {
  struct Setting {
    std::string key;
    SourcePosition position;  ///< of the key
    FieldValue value;
  };
  std::string name;
  SourcePosition position;  ///< of the name
  std::vector<Setting> settings;
};

/// A robot file as written: every field with its exact value and its place.
///
/// Source: the format of the thesis's Appendix B, extended.
struct RobotFile {
  std::string file_name;  ///< as given to the reader, for messages
  std::string text;       ///< the whole text
  /// What positions speak of: the text, or the description that the text was made of.
  std::string source_text;
  /// "URDF", "MJCF": the text was made of such a description, whose bodies its reader has checked;
  /// a 0 is a number there and no knowledge. Empty: the robot file itself.
  std::string made_of;
  std::string name;     ///< the `name` row, else the file's stem
  int joint_count = 0;  ///< number_link, 1..kMaxJoints
  DhConvention convention = DhConvention::kModified;
  ParameterMeaning parameters = ParameterMeaning::kBodies;
  std::array<Row, kRowKeyCount> rows;
  std::vector<std::string> joint_names;  ///< empty, or joint_count names
  std::vector<EffectRow> effects;
  std::vector<RowText> texts;  ///< all rows, in the order of the text
  SourcePosition last_word;    ///< of the file: where messages about what is missing stand
  std::vector<Diagnostic> warnings;

  [[nodiscard]] const Row& row(RowKey key) const { return rows[static_cast<std::size_t>(key)]; }
};

/// The keyword of a row as the documentation writes it ("al", "mX", "XX", "Fs", "qmin", ...).
std::string_view row_keyword(RowKey key);

/// What else is checked of a file, together with the rest: its rows may be wrong and short.
using FurtherCheck = std::function<void(const RobotFile&, Diagnostics&)>;

/// Reads a robot file from text.
///
/// @param text       the file's content, any bytes
/// @param file_name  used in messages, and its stem as the robot's name where no `name` row stands
/// @param further    may be empty
/// @throws ModelError  with up to 20 positioned messages
RobotFile parse_robot_file(std::string text, std::string file_name,
                           const FurtherCheck& further = {});

/// A robot file that was made of another description, and where its values come from.
struct MadeText {
  std::string text;         ///< of the robot file
  std::string source_text;  ///< of the description
  std::string made_of;      ///< as in RobotFile; empty: bodies are checked as those of robot files
  struct Place {
    SourcePosition position;
    int length = 1;
  };
  /// Of the value in a column (from 0) of a row; of the whole for columns that do not exist.
  std::function<Place(RowKey, std::size_t)> place;
  std::vector<Diagnostic> warnings;  ///< of the description
};

/// The same of a text that was made: messages have the description's places.
/// @throws InternalError  if the text is no robot file
RobotFile parse_made_robot_file(MadeText made, std::string file_name,
                                const FurtherCheck& further = {});

/// What a file of a description holds.
/// @throws ModelError  if it cannot be read: the message names the file and the reason
std::string read_description(const std::string& path);

}  // namespace dyngen
