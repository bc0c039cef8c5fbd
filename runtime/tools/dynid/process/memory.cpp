// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/process/memory.h"

#include <cstdlib>  // __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dyngen::runtime {

#ifdef __GLIBC__
namespace {

constexpr int kLarge = 16 << 20;  // bytes: what is larger goes back at once
constexpr int kKept = 256 << 20;  // at the end of the heap
constexpr int kStep = 16 << 20;   // that the heap grows by

}  // namespace

void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_TOP_PAD, kStep);
}
#else
void keep_memory() {}
#endif

}  // namespace dyngen::runtime
