// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/diagnosis/scans/generic_structure.h"

namespace dyngen::runtime {

/// Whether it is a function of the motion, of any kind.
bool is_function(const GenericStructure& structure);

/// Values between which functions are straight lines: of each variable, or of a product of two
/// velocities; none of what is no function.
using StructureKnots = std::vector<std::vector<double>>;
StructureKnots structure_knots(const EffectRecordings& data, EffectSignals& signals,
                               const GenericStructure& structure);

/// Columns of a structure, behind the parallel filter. Impulses need the motion at all samples;
/// lines and waves their frequency.
JointColumns generic_columns(const EffectRecordings& data, EffectSignals& signals,
                             const GenericStructure& structure);
/// The same functions as on other recordings. @param knots  of those
JointColumns generic_columns(const EffectRecordings& data, EffectSignals& signals,
                             const GenericStructure& structure, const StructureKnots& knots);

/// What a function of the motion may be made of, behind the parallel filter.
/// @return (equations x any)
Eigen::MatrixXd function_shapes(const EffectRecordings& data, EffectSignals& signals,
                                const GenericStructure& structure);
/// Cosines and sines of a sum of two joints' positions, behind the parallel filter.
/// @param frequencies  (2 x m) 1/rad or 1/m
/// @return             (equations x 2m), two columns for each pair of frequencies
Eigen::MatrixXd wave_shapes(const EffectRecordings& data, int first, int second,
                            const Eigen::Matrix2Xd& frequencies);
/// Columns of one joint, without the equations of it that do not count.
/// @param shapes  (equations x any)
JointColumns counted_columns(const EffectRecordings& data, int joint, Eigen::MatrixXd shapes);

}  // namespace dyngen::runtime
