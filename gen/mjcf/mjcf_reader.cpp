// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gen/bodies/body_judgement.h"
#include "gen/mjcf/mjcf_contents.h"
#include "gen/mjcf/mjcf_couplings.h"
#include "gen/mjcf/mjcf_defaults.h"
#include "gen/mjcf/mjcf_inertia.h"
#include "gen/mjcf/mjcf_joints.h"
#include "gen/mjcf/mjcf_settings.h"
#include "gen/mjcf/mjcf_words.h"

namespace dyngen {

namespace {

constexpr std::array<std::string_view, 7> kRefusedElements = {
    "include", "replicate", "attach", "composite", "flexcomp", "plugin", "dynamic_body"};

std::string way_out_of(std::string_view element) {
  if (element == "plugin") return "what a plugin does to torque is not known";
  return "write the bodies out: MuJoCo does where it saves a loaded model (mj_saveLastXML)";
}

class MjcfReader {
 public:
  MjcfReader(const XmlDocument& document, const ReadingOptions& options)
      : document_(document),
        diagnostics_(document.file_name, document.text),
        values_(document, diagnostics_),
        settings_(read_mjcf_settings(document.root, options, values_)),
        defaults_(document.root, values_),
        joints_(settings_, defaults_, values_) {}

  BodyTree read() {
    const XmlElement& root = document_.root;
    tree_.format = "MJCF";
    tree_.place = place_in_mjcf(root);
    tree_.gravity_place = settings_.gravity_place;
    tree_.base_acceleration = -settings_.gravity;
    if (const XmlAttribute* name = root.attribute("model")) tree_.name = name->value;
    TreeBody world;
    world.name = "world";
    world.place = world.inertial_place = place_in_mjcf(root);
    tree_.bodies.push_back(std::move(world));
    bool any = false;
    check_mjcf_words(root, values_);
    for (const XmlElement& child : root.children) {
      refuse_element(child);
      if (child.name != "worldbody") continue;
      any = true;
      read_children(child, 0, RigidPose{}, "");
    }
    if (!any) values_.error(root, "the model has no <worldbody>", "expected bodies");
    read_mjcf_couplings(root, defaults_, values_, tree_);
    if (diagnostics_.has_errors()) throw ModelError(diagnostics_.render());
    set_total_mass(settings_, tree_);
    tree_.warnings = diagnostics_.all();
    judge_bodies(tree_, tree_.warnings);
    return std::move(tree_);
  }

 private:
  bool refuse_element(const XmlElement& element) {
    const bool refused = std::find(kRefusedElements.begin(), kRefusedElements.end(),
                                   element.name) != kRefusedElements.end();
    if (refused) {
      values_.error(element, fmt::format("<{}> is not read", element.name),
                    way_out_of(element.name));
    }
    return refused;
  }

  /// Bodies of a body or a frame. @param around  of the element's frame in the body's
  void read_children(const XmlElement& element, int body, const RigidPose& around,
                     const std::string& given_class) {
    for (const XmlElement& child : element.children) {
      if (refuse_element(child)) continue;
      if (child.name == "body") read_body(child, body, around, given_class);
      if (child.name == "frame") {
        read_children(child, body, around * frame_pose(child), class_inside(child, given_class));
      }
    }
  }

  RigidPose frame_pose(const XmlElement& element) {
    MjcfAttributes attributes;
    attributes.take(element);
    return mjcf_pose(attributes, settings_.angles, values_);
  }

  std::string class_inside(const XmlElement& element, const std::string& given_class) {
    const XmlAttribute* own = element.attribute("childclass");
    if (own == nullptr) return given_class;
    if (!defaults_.has(own->value)) {
      values_.error(*own, fmt::format("default class '{}' does not exist", printable(own->value)),
                    "expected the class of a <default>");
    }
    return own->value;
  }

  void collect(const XmlElement& element, const RigidPose& around, const std::string& given_class,
               MjcfContents& contents) {
    for (const XmlElement& child : element.children) {
      if (child.name == "joint" || child.name == "freejoint") {
        contents.joints.push_back({&child, around, given_class});
      } else if (child.name == "geom") {
        contents.geoms.push_back({&child, around, given_class});
      } else if (child.name == "inertial") {
        contents.inertial = &child;
      } else if (child.name == "frame") {
        collect(child, around * frame_pose(child), class_inside(child, given_class), contents);
      }
    }
  }

  void read_body(const XmlElement& element, int parent, const RigidPose& around,
                 const std::string& given_class) {
    if (tree_.bodies.size() > static_cast<std::size_t>(kMaxBodies)) {
      values_.error(element, "too many bodies", fmt::format("at most {} are read", kMaxBodies));
      return;
    }
    const std::string inside = class_inside(element, given_class);
    TreeBody body;
    body.place = body.inertial_place = place_in_mjcf(element);
    const XmlAttribute* name = element.attribute("name");
    body.name = name != nullptr ? name->value : fmt::format("body{}", tree_.bodies.size());
    if (!names_of_bodies_.emplace(body.name, element.position.line).second ||
        body.name == "world") {
      values_.error(element, fmt::format("body '{}' stands twice", printable(body.name)),
                    "each body has a name of its own");
    }
    if (const XmlAttribute* gravity = element.attribute("gravcomp")) {
      if (values_.number(*gravity).value_or(0) != 0) {
        values_.warning(*gravity,
                        fmt::format("gravcomp of body '{}' is left out", printable(body.name)),
                        "the model has the whole weight");
      }
    }
    MjcfContents contents;
    collect(element, RigidPose{}, inside, contents);
    read_mjcf_inertia(contents, settings_, defaults_, values_, body);
    const RigidPose pose = around * frame_pose(element);
    const int own = add_body(std::move(body), contents, parent, pose);
    read_children(element, own, RigidPose{}, inside);
  }

  /// @return  the body's place
  int add_body(TreeBody body, const MjcfContents& contents, int parent, const RigidPose& pose) {
    std::vector<MjcfJoint> joints;
    for (const MjcfItem& item : contents.joints) joints.push_back(joints_.read(item, body.name));
    if (joints.empty()) {
      TreeJoint fixed;
      fixed.name = body.name + "_fixed";
      fixed.place = fixed.pose_place = fixed.limit_place = fixed.dynamics_place = body.place;
      joints.push_back({std::move(fixed)});
    }
    RigidPose step = pose;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      TreeJoint& joint = joints[i].joint;
      joint.parent = parent;
      joint.child = static_cast<int>(tree_.bodies.size());
      joint.pose = step * from_reference(joint, joints[i].reference);
      step = RigidPose{};
      if (i + 1 < joints.size()) {
        TreeBody between;
        between.name = fmt::format("{}_{}", body.name, i + 1);
        between.place = between.inertial_place = joint.place;
        tree_.bodies.push_back(std::move(between));
      }
      parent = joint.child;
      tree_.joints.push_back(std::move(joint));
    }
    tree_.bodies.push_back(std::move(body));
    return parent;
  }

  /// At q = ref the body stands as it is described.
  static RigidPose from_reference(const TreeJoint& joint, Real reference) {
    if (reference == 0) return {};
    if (joint.type == TreeJointType::kPrismatic) {
      return {RealMatrix::identity(), -reference * joint.axis};
    }
    const RealMatrix turn = turn_about(joint.axis, -reference);
    return {turn, joint.point - turn * joint.point};
  }

  const XmlDocument& document_;
  Diagnostics diagnostics_;
  XmlValues values_;
  MjcfSettings settings_;
  MjcfDefaults defaults_;
  MjcfJoints joints_;
  BodyTree tree_;
  std::map<std::string, int> names_of_bodies_;  // lines
};

}  // namespace

BodyTree read_mjcf(const XmlDocument& document, const ReadingOptions& options) {
  return MjcfReader(document, options).read();
}

}  // namespace dyngen
