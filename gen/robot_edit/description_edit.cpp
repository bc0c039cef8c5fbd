// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_edit/description_edit.h"

#include "gen/bodies/decimal.h"
#include "gen/diagnostic/assert.h"
#include "gen/robot_edit/edit_formats.h"

namespace dyngen {

const XmlElement& element_of(const DescribedBodies& bodies, const TextPlace& place) {
  const XmlElement* element = element_at(bodies.document.root, place.position);
  DYNGEN_ASSERT(element != nullptr, "bodies and joints have elements");
  return *element;
}

std::string spelled_numbers(const std::vector<Real>& values) {
  std::string text;
  for (const Real value : values) {
    if (!text.empty()) text += ' ';
    text += exact_decimal(value);
  }
  return text;
}

EditedDescription edited(const DescribedBodies& bodies, const DescriptionEdit& edit) {
  TextPatches patches;
  EditedDescription result;
  insert_comment(patches, bodies.document, edit.comment);
  const bool is_urdf = bodies.form == RobotForm::kUrdf;
  if (!is_urdf && !edit.bodies.empty()) refuse_overriding_compiler(bodies);
  for (const BodyEdit& body : edit.bodies) {
    is_urdf ? edit_urdf_body(patches, bodies, body) : edit_mjcf_body(patches, bodies, body);
  }
  for (const JointEdit& joint : edit.joints) {
    is_urdf ? edit_urdf_joint(patches, bodies, joint) : edit_mjcf_joint(patches, bodies, joint);
  }
  for (const DriveEdit& drive : edit.drives) {
    result.drives_left_out.push_back(is_urdf ? "URDF has no field for it"
                                             : edit_mjcf_drive(patches, bodies, drive));
  }
  result.text = patches.applied(bodies.document.text);
  return result;
}

}  // namespace dyngen
