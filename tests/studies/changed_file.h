// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::test {

/// A temporary copy of a robot file without the rows of some keywords: what is absent is zero. It
/// goes with the object.
class ChangedFile {
 public:
  /// @param path_in_project  "robots/planar2r.robot"
  /// @throws std::invalid_argument  if it cannot be read
  ChangedFile(const std::string& path_in_project, const std::vector<std::string>& left_out);
  ~ChangedFile();
  ChangedFile(const ChangedFile&) = delete;
  ChangedFile& operator=(const ChangedFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace dyngen::test
