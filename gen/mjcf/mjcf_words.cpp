// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/words/spelling.h"
#include "gen/xml/known_attributes.h"

namespace dyngen {
namespace {

using MjcfWords = std::vector<std::string_view>;

MjcfWords joined_words(MjcfWords a, const MjcfWords& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const MjcfWords kOrientations = {"quat", "axisangle", "xyaxes", "zaxis", "euler"};

/// Source: the XML reference of MuJoCo, mujoco.readthedocs.io/en/stable/XMLreference.html, of
/// versions 2 and 3.
const std::map<std::string_view, MjcfWords> kMjcfAttributes = {
    {"compiler",
     {"autolimits", "boundmass",   "boundinertia",    "settotalmass",      "balanceinertia",
      "strippath",  "coordinate",  "angle",           "fitaabb",           "eulerseq",
      "meshdir",    "texturedir",  "assetdir",        "discardvisual",     "convexhull",
      "usethread",  "fusestatic",  "inertiafromgeom", "inertiagrouprange", "exactmeshinertia",
      "alignfree",  "saveinertial"}},
    {"option",
     {"timestep",
      "apirate",
      "impratio",
      "tolerance",
      "ls_tolerance",
      "noslip_tolerance",
      "mpr_tolerance",
      "ccd_tolerance",
      "sleep_tolerance",
      "gravity",
      "wind",
      "magnetic",
      "density",
      "viscosity",
      "o_margin",
      "o_solref",
      "o_solimp",
      "o_friction",
      "integrator",
      "collision",
      "cone",
      "jacobian",
      "solver",
      "iterations",
      "ls_iterations",
      "noslip_iterations",
      "mpr_iterations",
      "ccd_iterations",
      "sdf_iterations",
      "sdf_initpoints",
      "actuatorgroupdisable"}},
    {"default", {"class"}},
    {"worldbody", joined_words({"name", "childclass", "pos"}, kOrientations)},
    {"frame", joined_words({"name", "childclass", "pos"}, kOrientations)},
    {"body", joined_words({"name", "childclass", "mocap", "pos", "user", "gravcomp", "sleep"},
                          kOrientations)},
    {"inertial", joined_words({"pos", "mass", "diaginertia", "fullinertia"}, kOrientations)},
    {"joint",
     {"name",
      "class",
      "type",
      "group",
      "pos",
      "axis",
      "springdamper",
      "limited",
      "actuatorfrclimited",
      "solreflimit",
      "solimplimit",
      "solreffriction",
      "solimpfriction",
      "stiffness",
      "range",
      "actuatorfrcrange",
      "actuatorgravcomp",
      "margin",
      "ref",
      "springref",
      "armature",
      "damping",
      "frictionloss",
      "user"}},
    {"freejoint", {"name", "group", "align"}},
    {"geom",
     joined_words(
         {"name",         "class",  "type",     "contype",  "conaffinity", "condim",    "group",
          "priority",     "size",   "material", "rgba",     "friction",    "mass",      "density",
          "shellinertia", "solmix", "solref",   "solimp",   "margin",      "gap",       "fromto",
          "pos",          "hfield", "mesh",     "fitscale", "fluidshape",  "fluidcoef", "user"},
         kOrientations)},
};

/// In bodies, frames and the world.
const MjcfWords kMjcfElements = {"body",     "frame",  "joint",  "freejoint", "geom",
                                 "inertial", "site",   "camera", "light",     "composite",
                                 "flexcomp", "plugin", "attach", "replicate", "include"};

const MjcfWords kTruth = {"true", "false"};
const MjcfWords kTruthOrAuto = {"true", "false", "auto"};
const std::map<std::string_view, const MjcfWords*> kTruthValues = {
    {"limited", &kTruthOrAuto}, {"mocap", &kTruth},
    {"autolimits", &kTruth},    {"inertiafromgeom", &kTruthOrAuto},
    {"discardvisual", &kTruth}, {"balanceinertia", &kTruth},
    {"fusestatic", &kTruth}};

class MjcfWordCheck {
 public:
  explicit MjcfWordCheck(XmlValues& values) : values_(values) {}

  void check_root(const XmlElement& root) {
    for (const XmlElement& child : root.children) {
      if (child.name == "compiler" || child.name == "option") check_attributes(child);
      if (child.name == "default") check_defaults(child);
      if (child.name == "worldbody") check_bodies(child);
      if (child.name == "compiler") check_compiler(child);
    }
  }

 private:
  void check_attributes(const XmlElement& element) {
    const auto known = kMjcfAttributes.find(element.name);
    if (known == kMjcfAttributes.end()) return;
    warn_of_unknown_attributes(element, known->second, "MJCF", values_);
    for (const XmlAttribute& attribute : element.attributes) {
      const auto words = kTruthValues.find(attribute.name);
      if (words == kTruthValues.end()) continue;
      const MjcfWords& allowed = *words->second;
      if (std::find(allowed.begin(), allowed.end(), attribute.value) != allowed.end()) continue;
      values_.error(
          attribute,
          fmt::format("'{}' is no value of {}", printable(attribute.value), attribute.name),
          allowed.size() == 2 ? "expected true or false" : "expected true, false or auto");
    }
  }

  void check_compiler(const XmlElement& compiler) {
    const XmlAttribute* discard = compiler.attribute("discardvisual");
    if (discard == nullptr || discard->value != "true") return;
    values_.warning(
        *discard,
        "geoms that do not collide count here with their mass; MuJoCo 2 leaves them out "
        "with it",
        "give bodies an <inertial>, or these geoms mass=\"0\"");
  }

  void check_defaults(const XmlElement& element) {
    check_attributes(element);
    for (const XmlElement& child : element.children) {
      if (child.name == "default") check_defaults(child);
      if (child.name == "joint" || child.name == "geom") check_attributes(child);
    }
  }

  void check_bodies(const XmlElement& element) {
    check_attributes(element);
    int inertials = 0;
    for (const XmlElement& child : element.children) {
      if (std::find(kMjcfElements.begin(), kMjcfElements.end(), child.name) ==
          kMjcfElements.end()) {
        const std::string_view near = nearest_word(child.name, kMjcfElements);
        values_.warning(child,
                        fmt::format("<{}> is no element of MJCF's bodies: it is passed over",
                                    printable(child.name)),
                        near.empty() ? std::string() : fmt::format("did you mean <{}>?", near));
      }
      const bool of_body =
          child.name == "joint" || child.name == "freejoint" || child.name == "inertial";
      if (element.name == "worldbody" && of_body) {
        values_.error(child, fmt::format("a <{}> stands in the world", child.name),
                      "expected it in a <body>");
      }
      if (child.name == "inertial" && ++inertials > 1) {
        values_.error(child, "a second <inertial> of one body", "expected one");
      }
      if (child.name == "inertial") check_inertial(child);
      if (child.name == "body" || child.name == "frame") {
        check_bodies(child);
      } else {
        check_attributes(child);
      }
    }
  }

  void check_inertial(const XmlElement& inertial) {
    const XmlAttribute* full = inertial.attribute("fullinertia");
    if (full == nullptr) return;
    if (inertial.attribute("diaginertia") != nullptr) {
      values_.error(*full, "fullinertia stands beside diaginertia", "expected one of them");
    }
    for (const std::string_view turn : kOrientations) {
      const XmlAttribute* found = inertial.attribute(turn);
      if (found == nullptr) continue;
      values_.error(*found, fmt::format("{} stands beside fullinertia", turn),
                    "fullinertia has the body's axes: expected diaginertia, or no turn");
    }
  }

  XmlValues& values_;
};

}  // namespace

void check_mjcf_words(const XmlElement& root, XmlValues& values) {
  MjcfWordCheck(values).check_root(root);
}

}  // namespace dyngen
