// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/process/memory.h"

#include <cstdlib>  // __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dyngen::runtime {

#ifdef __GLIBC__
namespace {

constexpr int kAlways = 1 << 30;   // bytes at the end of the heap that stay
constexpr int kAtOnce = 64 << 20;  // bytes that the heap grows by

}  // namespace

void keep_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kAlways);
  mallopt(M_TOP_PAD, kAtOnce);
}
#else
void keep_memory() {}
#endif

}  // namespace dyngen::runtime
