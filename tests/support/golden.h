// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dyngen::test {

/// Checks a text against tests/golden/<path>, byte for byte. A mismatch fails with the lines that
/// differ and the command that accepts the new text; with DYNGEN_UPDATE_GOLDEN set the file is
/// written instead.
void expect_golden(const std::string& path, const std::string& text);

}  // namespace dyngen::test
