// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace dyngen {

/// An invariant of ours does not hold: our bug, not the user's.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace dyngen

/// Throws InternalError with the place and the broken condition; dyngen then exits with 70.
#define DYNGEN_ASSERT(condition, explanation)                                                \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      throw ::dyngen::InternalError(std::string(__FILE__) + ":" + std::to_string(__LINE__) + \
                                    ": " #condition ": " + (explanation));                   \
    }                                                                                        \
  } while (false)
