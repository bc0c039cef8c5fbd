// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/mjcf/mjcf_inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gen/mjcf/geom_inertia.h"

namespace dyngen {
namespace {

class InertiaReader {
 public:
  InertiaReader(const MjcfSettings& settings, const MjcfDefaults& defaults, XmlValues& values)
      : settings_(settings), defaults_(defaults), values_(values) {}

  void read(const MjcfContents& contents, TreeBody& body) {
    const bool given = contents.inertial != nullptr && settings_.inertia != InertiaSource::kGeoms;
    if (given) {
      read_inertial(*contents.inertial, body);
    } else if (settings_.inertia != InertiaSource::kInertial) {
      add_geoms(contents, body);
    }
    bound(body);
  }

 private:
  void read_inertial(const XmlElement& element, TreeBody& body) {
    MjcfAttributes own;
    own.take(element);
    const std::string whose = fmt::format("the inertial of body '{}'", printable(body.name));
    body.has_inertial = true;
    body.inertial_place = place_in_mjcf(element);
    const RigidPose pose = mjcf_pose(own, settings_.angles, values_);
    values_.required(element, "pos", whose);
    body.centre = pose.p;
    if (const XmlAttribute* mass = values_.required(element, "mass", whose)) {
      body.mass = values_.number(*mass).value_or(0);
    }
    RealMatrix tensor;
    if (const XmlAttribute* full = own.find("fullinertia")) {
      if (const auto v = values_.numbers(*full, 6)) {
        for (std::size_t k = 0; k < 3; ++k) tensor[k][k] = (*v)[k];
        tensor[0][1] = tensor[1][0] = (*v)[3];
        tensor[0][2] = tensor[2][0] = (*v)[4];
        tensor[1][2] = tensor[2][1] = (*v)[5];
      }
    } else if (const auto diagonal = mjcf_vector(own, "diaginertia", values_)) {
      for (std::size_t k = 0; k < 3; ++k) tensor[k][k] = (*diagonal)[k];
    } else {
      values_.error(element, whose + " has neither diaginertia nor fullinertia",
                    "expected one of them");
    }
    body.inertia = turned(pose.R, tensor);
  }

  void add_geoms(const MjcfContents& contents, TreeBody& body) {
    std::vector<GeomInertia> solids;
    for (const MjcfItem& item : contents.geoms) {
      const MjcfAttributes own = defaults_.of(*item.element, "geom", item.given_class, values_);
      const XmlAttribute* group = own.find("group");
      const Real number = group == nullptr ? 0 : values_.number(*group).value_or(0);
      if (number < settings_.first_group || number > settings_.last_group) continue;
      const auto solid = geom_inertia(*item.element, own, item.around, settings_.angles, values_);
      if (solid && solid->mass != 0) solids.push_back(*solid);
    }
    for (const GeomInertia& solid : solids) {
      body.mass += solid.mass;
      body.centre = body.centre + solid.mass * solid.centre;
    }
    if (body.mass == 0) return;
    body.has_inertial = true;
    body.centre = (1 / body.mass) * body.centre;
    for (const GeomInertia& solid : solids) {
      body.inertia =
          body.inertia + solid.inertia + parallel_axes(solid.mass, solid.centre - body.centre);
    }
  }

  /// What <compiler> makes of masses and moments, in MuJoCo's order.
  void bound(TreeBody& body) const {
    body.mass = std::max(body.mass, settings_.least_mass);
    if (settings_.least_moment <= 0 && !settings_.balance_inertia) return;
    RealMatrix axes;
    RealVector p = principal_moments(body.inertia, &axes);
    bool changed = false;
    for (std::size_t k = 0; k < 3; ++k) {
      changed = changed || p[k] < settings_.least_moment;
      p[k] = std::max(p[k], settings_.least_moment);
    }
    if (settings_.balance_inertia && p[0] + p[1] < p[2]) {
      const Real mean = (p[0] + p[1] + p[2]) / 3;
      p = {{mean, mean, mean}};
      changed = true;
    }
    if (!changed) return;
    RealMatrix diagonal;
    for (std::size_t k = 0; k < 3; ++k) diagonal[k][k] = p[k];
    body.inertia = turned(axes, diagonal);
  }

  const MjcfSettings& settings_;
  const MjcfDefaults& defaults_;
  XmlValues& values_;
};

}  // namespace

void read_mjcf_inertia(const MjcfContents& contents, const MjcfSettings& settings,
                       const MjcfDefaults& defaults, XmlValues& values, TreeBody& body) {
  InertiaReader(settings, defaults, values).read(contents, body);
}

void set_total_mass(const MjcfSettings& settings, BodyTree& tree) {
  if (settings.total_mass <= 0) return;
  Real sum = 0;
  for (const TreeBody& body : tree.bodies) sum += body.mass;
  if (sum == 0) return;
  const Real factor = settings.total_mass / sum;
  for (TreeBody& body : tree.bodies) {
    body.mass *= factor;
    body.inertia = factor * body.inertia;
  }
}

}  // namespace dyngen
