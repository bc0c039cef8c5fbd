// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/lanes.h"

#include <fmt/format.h>

#include "gen/emit_c/c_spelling.h"

namespace dyngen {
namespace {

// {0} is the prefix, {1} the prefix in capitals.
constexpr const char* kDoubles =
    R"(/* As many doubles as one register holds, where the compiler has GNU C vectors; else one. */
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__aarch64__))
#define {1}_VECTORS
#if defined(__AVX512F__)
#define {1}_DOUBLES 8
#elif defined(__AVX2__)
#define {1}_DOUBLES 4
#else
#define {1}_DOUBLES 2
#endif
#define {1}_NOINLINE __attribute__((noinline))
#define {1}_INLINE inline __attribute__((always_inline))
#define {1}_AT(x, i) x[(i) / {1}_DOUBLES][(i) % {1}_DOUBLES]
typedef double {0}_doubles __attribute__((vector_size(8 * {1}_DOUBLES)));
typedef unsigned long long {0}_bits __attribute__((vector_size(8 * {1}_DOUBLES)));
#else
#define {1}_DOUBLES 1
#define {1}_NOINLINE
#define {1}_INLINE inline
#define {1}_AT(x, i) x[i]
typedef double {0}_doubles;
#endif
)";

}  // namespace

std::string doubles_helper(const std::string& prefix) {
  return fmt::format(fmt::runtime(kDoubles), prefix, upper_case(prefix));
}

}  // namespace dyngen
