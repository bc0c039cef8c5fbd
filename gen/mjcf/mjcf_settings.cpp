// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace dyngen {

namespace {

class SettingsReader {
 public:
  SettingsReader(MjcfSettings& settings, XmlValues& values)
      : settings_(settings), values_(values) {}

  void read_compiler(const XmlElement& compiler) {
    for (const XmlAttribute& own : compiler.attributes) read_compiler_word(own);
  }

  void read_option(const XmlElement& option) {
    if (const XmlAttribute* gravity = option.attribute("gravity")) {
      settings_.gravity_place = {gravity->position, gravity->length};
      if (const auto v = values_.numbers(*gravity, 3)) {
        settings_.gravity = {{(*v)[0], (*v)[1], (*v)[2]}};
      }
    }
    for (const std::string_view name : {"density", "viscosity"}) {
      const XmlAttribute* fluid = option.attribute(name);
      if (fluid == nullptr || values_.number(*fluid).value_or(0) == 0) continue;
      values_.warning(*fluid, fmt::format("the fluid's {} is left out", name),
                      "drag of a medium is not in the model");
    }
    for (const XmlElement& flag : option.children) {
      if (flag.name == "flag") read_flags(flag);
    }
  }

 private:
  bool is_true(const XmlAttribute& own) {
    if (own.value == "true" || own.value == "false") return own.value == "true";
    values_.error(own, fmt::format("{} is '{}'", own.name, printable(own.value)),
                  "expected true or false");
    return false;
  }

  void read_compiler_word(const XmlAttribute& own) {
    if (own.name == "angle") {
      if (own.value != "degree" && own.value != "radian") {
        values_.error(own, fmt::format("angle is '{}'", printable(own.value)),
                      "expected degree or radian");
      }
      settings_.angles.degrees = own.value != "radian";
    } else if (own.name == "eulerseq") {
      const bool axes =
          own.value.size() == 3 && own.value.find_first_not_of("xyzXYZ") == std::string::npos;
      if (axes) {
        settings_.angles.euler = own.value;
      } else {
        values_.error(own, fmt::format("eulerseq is '{}'", printable(own.value)),
                      "expected three of the letters x y z X Y Z");
      }
    } else if (own.name == "coordinate") {
      if (own.value != "local") {
        values_.error(own, fmt::format("coordinate=\"{}\" is not read", printable(own.value)),
                      "write the model in local coordinates; MuJoCo itself does: save the "
                      "compiled model");
      }
    } else if (own.name == "inertiafromgeom") {
      if (own.value == "auto") {
        settings_.inertia = InertiaSource::kInertialElseGeoms;
      } else {
        settings_.inertia = is_true(own) ? InertiaSource::kGeoms : InertiaSource::kInertial;
      }
    } else if (own.name == "inertiagrouprange") {
      if (const auto v = values_.numbers(own, 2)) {
        settings_.first_group = static_cast<int>(std::clamp<Real>((*v)[0], -1000, 1000));
        settings_.last_group = static_cast<int>(std::clamp<Real>((*v)[1], -1000, 1000));
      }
    } else if (own.name == "balanceinertia") {
      settings_.balance_inertia = is_true(own);
    } else if (own.name == "autolimits") {
      settings_.limits_by_range = is_true(own);
    } else if (own.name == "boundmass") {
      settings_.least_mass = values_.number(own).value_or(0);
    } else if (own.name == "boundinertia") {
      settings_.least_moment = values_.number(own).value_or(0);
    } else if (own.name == "settotalmass") {
      settings_.total_mass = values_.number(own).value_or(-1);
    }  // the others are about files, meshes and speed
  }

  void read_flags(const XmlElement& flag) {
    for (const XmlAttribute& own : flag.attributes) {
      if (own.name == "gravity" && own.value == "disable") {
        settings_.gravity = {};
        settings_.gravity_place = {own.position, own.length};
      }
      const bool passive = own.name == "passive" || own.name == "frictionloss";
      if (passive && own.value == "disable") {
        values_.warning(own, fmt::format("flag {}=\"disable\" is passed over", own.name),
                        "damping, springs and dry friction of the joints are in the model");
      }
    }
  }

  MjcfSettings& settings_;
  XmlValues& values_;
};

}  // namespace

MjcfSettings read_mjcf_settings(const XmlElement& root, const ReadingOptions& options,
                                XmlValues& values) {
  MjcfSettings settings;
  settings.gravity_place = {root.position, root.length};
  settings.angles.tolerance = std::max(kSameAngle, options.round_angles);
  SettingsReader reader(settings, values);
  for (const XmlElement& child : root.children) {
    if (child.name == "compiler") reader.read_compiler(child);
    if (child.name == "option") reader.read_option(child);
  }
  return settings;
}

}  // namespace dyngen
