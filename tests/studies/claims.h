// SPDX-License-Identifier: MIT
#pragma once

#include "tests/studies/method_table.h"

namespace dyngen::test {

/// Markdown: claims of the thesis of 1995, each with what was measured.
void print_claims(const StudyRobot& robot, const StudyPlan& plan);

}  // namespace dyngen::test
