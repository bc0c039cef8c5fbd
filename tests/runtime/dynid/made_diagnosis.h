// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/diagnose/diagnosis_report.h"

namespace dyngen::test {

/// The arm of the thesis with three joints, tests/studies/robots/puma3.robot.
const runtime::DescribedRobot& made_robot();

/// An effect of the program's own with numbers. @param joint, other  coordinates; -1: none
runtime::EffectInstance made_effect(const std::string& name, int joint, int other,
                                    const std::vector<double>& parameters);

/// A diagnosis written by hand that has something in every part: what it is made of is told in
/// made_diagnosis.cpp.
runtime::Diagnosis made_diagnosis();

/// It as the tool reports it.
runtime::DiagnosisReport made_report();

}  // namespace dyngen::test
