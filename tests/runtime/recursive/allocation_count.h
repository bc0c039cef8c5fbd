// SPDX-License-Identifier: MIT
#pragma once

namespace dyngen::test {

/// Calls of malloc and its kin (operator new and Eigen end there) in this program so far.
long allocation_count();

}  // namespace dyngen::test
