// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>

#include "runtime/identification/summary.h"

namespace dyngen::runtime {

/// A file of summaries that cannot be read; what() names the file, the place and the reason.
class SummaryFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a .qr file: the word "dyngenqr", a version, little-endian numbers, and a checksum
/// of all that stands before it. docs/howto/fleet.md has the layout.
std::string write_summaries(const RobotSummaries& all);

/// @param name  of the file, for messages
/// @throws SummaryFileError  another format or version, cut off, or a checksum that does not fit
RobotSummaries read_summaries(const std::string& bytes, const std::string& name);

/// @throws SummaryFileError
RobotSummaries read_summary_file(const std::string& path);

/// Whether a file begins as a .qr file does.
bool is_summary_file(const std::string& path);

}  // namespace dyngen::runtime
