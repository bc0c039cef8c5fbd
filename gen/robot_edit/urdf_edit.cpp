// SPDX-License-Identifier: GPL-2.0-or-later
#include <array>
#include <string_view>
#include <utility>

#include "gen/bodies/decimal.h"
#include "gen/robot_edit/edit_formats.h"
#include "gen/xml/xml_values.h"

namespace dyngen {

namespace {

constexpr std::array<std::pair<std::string_view, std::pair<std::size_t, std::size_t>>, 6>
    kUrdfMoments = {{{"ixx", {0, 0}},
                     {"ixy", {0, 1}},
                     {"ixz", {0, 2}},
                     {"iyy", {1, 1}},
                     {"iyz", {1, 2}},
                     {"izz", {2, 2}}}};

std::string spelled_vector_of(const RealVector& v) { return spelled_numbers({v[0], v[1], v[2]}); }

/// The axes of an inertial's origin in the link's, as they are written.
RealMatrix axes_of(const DescribedBodies& bodies, const XmlElement* origin) {
  if (origin == nullptr) return RealMatrix::identity();
  const XmlAttribute* rpy = origin->attribute("rpy");
  if (rpy == nullptr) return RealMatrix::identity();
  Diagnostics diagnostics(bodies.document.file_name, bodies.document.text);
  const auto angles = XmlValues(bodies.document, diagnostics).numbers(*rpy, 3);
  if (!angles) throw ModelError(diagnostics.render());
  return turn_rpy({{(*angles)[0], (*angles)[1], (*angles)[2]}});
}

std::string new_inertial(const BodyEdit& edit) {
  std::string text = "<inertial><origin xyz=\"" + spelled_vector_of(edit.centre) +
                     "\" rpy=\"0 0 0\"/><mass value=\"" + exact_decimal(edit.mass) + "\"/><inertia";
  for (const auto& [name, place] : kUrdfMoments) {
    text += " " + std::string(name) + "=\"" +
            exact_decimal(edit.inertia[place.first][place.second]) + "\"";
  }
  return text + "/></inertial>";
}

}  // namespace

void edit_urdf_body(TextPatches& patches, const DescribedBodies& bodies, const BodyEdit& edit) {
  const TreeBody& body = bodies.robot.tree.bodies[static_cast<std::size_t>(edit.body)];
  const XmlElement& link = element_of(bodies, body.place);
  const XmlElement* inertial = link.child("inertial");
  if (inertial == nullptr) {
    insert_child(patches, bodies.document, link, new_inertial(edit));
    return;
  }
  const XmlElement* origin = inertial->child("origin");
  const RealMatrix moments = turned(transposed(axes_of(bodies, origin)), edit.inertia);
  if (origin == nullptr) {
    insert_child(patches, bodies.document, *inertial,
                 "<origin xyz=\"" + spelled_vector_of(edit.centre) + "\" rpy=\"0 0 0\"/>");
  } else {
    set_attribute(patches, *origin, "xyz", spelled_vector_of(edit.centre));
  }
  set_attribute(patches, *inertial->child("mass"), "value", exact_decimal(edit.mass));
  for (const auto& [name, place] : kUrdfMoments) {
    set_attribute(patches, *inertial->child("inertia"), name,
                  exact_decimal(moments[place.first][place.second]));
  }
}

void edit_urdf_joint(TextPatches& patches, const DescribedBodies& bodies, const JointEdit& edit) {
  const TreeJoint& joint = bodies.robot.tree.joints[static_cast<std::size_t>(edit.joint)];
  const XmlElement& element = element_of(bodies, joint.place);
  const XmlElement* dynamics = element.child("dynamics");
  if (dynamics == nullptr) {
    const Real damping = edit.damping.value_or(0), friction = edit.friction.value_or(0);
    if (damping == 0 && friction == 0) return;
    insert_child(patches, bodies.document, element,
                 "<dynamics damping=\"" + exact_decimal(damping) + "\" friction=\"" +
                     exact_decimal(friction) + "\"/>");
    return;
  }
  if (edit.damping) set_attribute(patches, *dynamics, "damping", exact_decimal(*edit.damping));
  if (edit.friction) set_attribute(patches, *dynamics, "friction", exact_decimal(*edit.friction));
}

}  // namespace dyngen
