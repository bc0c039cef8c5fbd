// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dyngen::test {

/// Logs that write_logs.py has written, in a folder of this process's own.
class WrittenLogs {
 public:
  WrittenLogs();
  ~WrittenLogs();
  WrittenLogs(const WrittenLogs&) = delete;
  WrittenLogs& operator=(const WrittenLogs&) = delete;

  /// Why there are none; empty: they are there.
  [[nodiscard]] const std::string& absent() const { return absent_; }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }
  [[nodiscard]] bool has(const std::string& name) const;

 private:
  std::string folder_, absent_;
};

/// Whether this library was built with what a log of this name needs; else what its error names.
std::string absent_package_of(const std::string& name);

}  // namespace dyngen::test
