// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen {

/// A place in a text; lines and columns count from 1, in every message.
///
/// Lines end at a line feed. Columns count characters (UTF-8 code points; a byte that is not UTF-8
/// counts as one). Line 0 stands for the file as a whole.
struct SourcePosition {
  int line = 0;
  int column = 0;
};

enum class Severity { kError, kWarning };

/// What is wrong and where: `message` says what was found and what was expected, `hint` (may be
/// empty) what to do.
struct Diagnostic {
  Severity severity = Severity::kError;
  SourcePosition position;
  int length = 1;  ///< characters to underline, >= 1
  std::string message;
  std::string hint;
};

/// Collects what is wrong with one input text and prints it.
///
/// At most kMaxErrors errors are kept (and as many warnings), the rest are counted; full() tells a
/// reader that it may stop looking for more.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxErrors = 20;

  Diagnostics(std::string file_name, std::string text);

  void error(SourcePosition position, int length, const std::string& message,
             const std::string& hint = {});
  void warning(SourcePosition position, int length, const std::string& message,
               const std::string& hint = {});

  [[nodiscard]] bool has_errors() const { return error_count_ > 0; }
  [[nodiscard]] bool full() const { return error_count_ >= kMaxErrors; }
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }

  /// Everything collected, in the order of the text, each as
  /// `file:line:col: error: message`, the line itself, and a caret line with the hint.
  [[nodiscard]] std::string render() const;

 private:
  std::string file_name_;
  std::string text_;
  std::vector<Diagnostic> all_;
  std::size_t error_count_ = 0;
  std::size_t warning_count_ = 0;
};

/// The user's file is wrong: what() is the rendered list of diagnostics.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A piece of the user's text, fit to stand in a message: what a terminal would not print becomes
/// '?', and a long piece is cut ("abcdef...").
std::string printable(std::string_view piece);

}  // namespace dyngen
