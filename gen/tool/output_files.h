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
/// are renamed.
/// @throws OutputError  nothing half-written stays behind: what could not be written is as it was
void write_files(const std::vector<OutputFile>& files);

/// A Make rule that says the targets depend on these files, with absolute paths.
std::string depfile_text(const std::vector<std::string>& targets,
                         const std::vector<std::string>& dependencies);

}  // namespace dyngen
