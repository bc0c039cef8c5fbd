// SPDX-License-Identifier: MIT
#pragma once

/// Signed whole numbers that a log holds as unsigned ones: 65535 for -1.
namespace dyngen::runtime {

/// The signed number: 2^bits is taken off what is 2^(bits - 1) and more.
/// @param bits  8, 16 or 32; 0: the value as it is
double signed_value(double value, int bits);

/// Judges the values of one column.
class UnsignedWatch {
 public:
  void look(double value);

  /// Of signed numbers that stand as unsigned ones: 8, 16 or 32; else 0. All values are whole and
  /// below 2^bits, some are in the lowest and some in the highest quarter of that range, and none
  /// is in the half between: what turns over without passing through there was signed.
  [[nodiscard]] int bits() const;

  [[nodiscard]] double largest() const { return largest_; }

 private:
  static constexpr int kRanges = 3;
  bool whole_ = true;
  double largest_ = 0;
  bool low_[kRanges] = {}, high_[kRanges] = {}, between_[kRanges] = {};
};

}  // namespace dyngen::runtime
