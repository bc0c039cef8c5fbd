// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/page/arm_drawing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace dyngen::runtime {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

double decimal(const GiNaC::ex& value) {
  return GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double();
}

double decimal(const Quantity& quantity) { return quantity.unknown ? 0 : decimal(quantity.value); }

ReportArm::Point point(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// Where a link lies that no other one hangs on: towards its mass, else along its x axis.
Vector3d direction_of(const JointModel& own) {
  const auto moment = [&](Chi kind) { return decimal(own.chi[static_cast<std::size_t>(kind)]); };
  const Vector3d mass(moment(Chi::kMX), moment(Chi::kMY), moment(Chi::kMZ));
  return mass.norm() > 1e-6 ? mass.normalized() : Vector3d::UnitX();
}

/// The last link of each branch, which a DH table says no length of: as long as the others.
void add_last_links(const RobotModel& model, const std::vector<Isometry3d>& frames,
                    ReportArm& arm) {
  double length = 0, count = 0;
  std::vector<bool> last(model.joints.size(), true);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Isometry3d& parent = frames[static_cast<std::size_t>(model.joints[i].parent)];
    const double step = (frames[i + 1].translation() - parent.translation()).norm();
    length += step;
    count += step > 1e-6 ? 1 : 0;
    if (model.joints[i].parent > 0)
      last[static_cast<std::size_t>(model.joints[i].parent) - 1] = false;
  }
  const double shown = 0.6 * (count > 0 ? length / count : 1);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (!last[i] || model.joints[i].coordinate < 0) continue;
    const Vector3d end = frames[i + 1] * (shown * direction_of(model.joints[i]));
    arm.joints[i].link.push_back(point(end));
  }
}

}  // namespace

ReportArm arm_drawing(const RobotModel& model, const Eigen::VectorXd& q,
                      const std::vector<int>& marked) {
  ReportArm arm;
  const Vector3d up(decimal(model.gravity[0]), decimal(model.gravity[1]), decimal(model.gravity[2]));
  if (up.norm() > 0) arm.up = point(up.normalized());
  std::vector<Isometry3d> frames = {Isometry3d::Identity()};
  for (const JointModel& own : model.joints) {
    const Isometry3d& parent = frames[static_cast<std::size_t>(own.parent)];
    const double at = own.coordinate >= 0 ? q[own.coordinate] : 0;
    const bool slides = own.type == JointType::kPrismatic;
    const double theta = decimal(own.theta) + (own.type == JointType::kRevolute ? at : 0);
    const double r = decimal(own.r) + (slides ? at : 0);
    const Isometry3d across = AngleAxisd(decimal(own.alpha), Vector3d::UnitX()) *
                              Translation3d(decimal(own.d), 0, 0);  // they commute
    const Isometry3d along = AngleAxisd(theta, Vector3d::UnitZ()) * Translation3d(0, 0, r);
    const bool modified = model.convention == DhConvention::kModified;
    const Isometry3d corner = parent * (modified ? across : along);
    frames.push_back(corner * (modified ? along : across));
    // a joint of the distal convention turns about the z axis of its parent's frame
    const Isometry3d& axis = modified ? frames.back() : parent;
    ReportArm::Joint joint;
    joint.label = own.name.empty() ? fmt::format("joint {}", own.coordinate + 1) : own.name;
    joint.coordinate = own.coordinate;
    joint.prismatic = slides;
    joint.at = point(axis.translation());
    joint.axis = point(axis.linear().col(2));
    joint.link = {point(parent.translation()), point(corner.translation()),
                  point(frames.back().translation())};
    joint.marked = own.coordinate >= 0 &&
                   std::find(marked.begin(), marked.end(), own.coordinate) != marked.end();
    arm.joints.push_back(std::move(joint));
  }
  add_last_links(model, frames, arm);
  return arm;
}

}  // namespace dyngen::runtime
