// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace dyngen::test {

/// An upright arm of two joints, and a folder of its own for what a test writes.
class RecordedArm : public testing::Test {
 protected:
  void SetUp() override;

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Writes the arm.
  /// @param rows      further rows: effects, limits
  /// @param friction  Coulomb friction of both joints, N m
  /// @return its path
  [[nodiscard]] std::string arm(const std::string& name, const std::string& rows,
                                const std::string& friction = "0.5 0.2") const;
  /// The same arm without a dynamic number.
  [[nodiscard]] std::string open_arm() const;
  /// Writes a motion of both joints from rest: sines of several frequencies, which they do not
  /// share. @param seconds  its length
  void waves(const std::string& name, double seconds) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace dyngen::test
