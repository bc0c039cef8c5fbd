// SPDX-License-Identifier: MIT
// Part of every program that is built with the address sanitizer.

/// CLN keeps a string of its own from before main() to the end.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln"; }
