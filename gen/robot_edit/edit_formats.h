// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/robot_edit/description_edit.h"
#include "gen/robot_edit/text_patches.h"

/// What edited() does in each format.
namespace dyngen {

void edit_urdf_body(TextPatches& patches, const DescribedBodies& bodies, const BodyEdit& edit);
void edit_urdf_joint(TextPatches& patches, const DescribedBodies& bodies, const JointEdit& edit);

/// @throws ModelError  as edited()
void refuse_overriding_compiler(const DescribedBodies& bodies);
void edit_mjcf_body(TextPatches& patches, const DescribedBodies& bodies, const BodyEdit& edit);
void edit_mjcf_joint(TextPatches& patches, const DescribedBodies& bodies, const JointEdit& edit);
/// @return why it cannot be written; empty: it was
std::string edit_mjcf_drive(TextPatches& patches, const DescribedBodies& bodies,
                            const DriveEdit& edit);

/// The element of a body or a joint of the tree.
const XmlElement& element_of(const DescribedBodies& bodies, const TextPlace& place);

/// "x y z"
std::string spelled_numbers(const std::vector<Real>& values);

}  // namespace dyngen
