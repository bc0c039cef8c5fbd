// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace dyngen::test {

/// A path for a file of this test alone: tests run side by side, each in a process of its own.
inline std::string temporary_path(const std::string& name) {
  return testing::TempDir() + std::to_string(getpid()) + "_" + name;
}

}  // namespace dyngen::test
