// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "gen/emit_c/emit_c.h"
#include "tests/support/shared_object.h"

namespace dyngen::test {

/// The sines and cosines that stand in emitted code, compiled.
class InlineTrigLibrary {
 public:
  static constexpr std::size_t kMostAngles = 8;  ///< of one call

  /// @param flags   of the compiler
  /// @param scalar  kFloat: those of single precision, which are computed as doubles too
  explicit InlineTrigLibrary(const std::string& flags, Scalar scalar = Scalar::kDouble);

  /// One call for all angles. @param angles  one to eight; sines and cosines are as long
  void operator()(std::span<const double> angles, std::span<double> sines,
                  std::span<double> cosines) const;

 private:
  SharedObject object_;
  void (*sincos_)(int, const double*, double*, double*) = nullptr;
};

/// Distance of a double from the exact value, in units in the last place of the exact value.
inline double units_in_the_last_place(double value, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact)) / ulp;
}

}  // namespace dyngen::test
