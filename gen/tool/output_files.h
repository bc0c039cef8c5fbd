// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace dyngen {

/// A file that is to be written.
struct OutputFile {
  std::string path;
  std::string content;
};

/// An output file could not be written; what() names it and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes all files: each goes to a temporary file beside its place, and when all are whole they
/// are renamed. What is no regular file, a pipe or /dev/null, is written to as it is.
/// @throws OutputError  nothing half-written stays behind: what could not be written is as it was
void write_files(const std::vector<OutputFile>& files);

/// Whether two paths lead to one file, by links too, or would if they were written. What is no
/// regular file (/dev/null) may stand several times.
bool is_same_file(const std::string& a, const std::string& b);

/// A Make rule that says the targets depend on these files, with absolute paths.
std::string depfile_text(const std::vector<std::string>& targets,
                         const std::vector<std::string>& dependencies);

}  // namespace dyngen
