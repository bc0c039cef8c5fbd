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

// The file without its folders: a program that is passed on does not say where it was built.
#ifdef __FILE_NAME__
#define DYNGEN_FILE_NAME __FILE_NAME__
#else
#define DYNGEN_FILE_NAME __FILE__
#endif

/// Throws InternalError with the place and the broken condition; dyngen then exits with 70.
#define DYNGEN_ASSERT(condition, explanation)                                         \
  do {                                                                                \
    if (!(condition)) {                                                               \
      throw ::dyngen::InternalError(std::string(DYNGEN_FILE_NAME) + ":" +             \
                                    std::to_string(__LINE__) + ": " #condition ": " + \
                                    (explanation));                                   \
    }                                                                                 \
  } while (false)
