// SPDX-License-Identifier: MIT
#include "tests/peers/made_mjcf.h"

#include <fmt/format.h>

#include <array>
#include <random>

namespace dyngen::test {
namespace {

class MjcfMaker {
 public:
  explicit MjcfMaker(unsigned seed) : random_(seed + 1000) {}

  std::string make() {
    degrees_ = pick(2) == 0;
    constexpr std::array<const char*, 6> kSequences = {"xyz", "zyx", "XYZ", "ZYX", "xyx", "xYz"};
    std::string text = fmt::format(
        "<mujoco model=\"made\">\n  <compiler{} eulerseq=\"{}\"{}/>\n"
        "  <option gravity=\"{} {} {}\"/>\n",
        degrees_ ? (pick(2) == 0 ? "" : " angle=\"degree\"") : " angle=\"radian\"",
        kSequences[static_cast<std::size_t>(pick(6))],
        pick(3) == 0 ? " inertiafromgeom=\"true\"" : "", number(-2, 2), number(-2, 2), -9.81);
    geoms_alone_ = text.find("inertiafromgeom") != std::string::npos;
    text += fmt::format(
        "  <default>\n    <joint armature=\"{}\"/>\n    <geom density=\"{}\"/>\n"
        "    <default class=\"arm\"><joint damping=\"{}\"/>\n"
        "      <default class=\"slider\"><joint type=\"slide\" axis=\"0 1 1\"/></default>\n"
        "    </default>\n  </default>\n  <worldbody>\n    <geom type=\"plane\" size=\"1 1 1\"/>\n",
        number(0, 0.2), number(200, 1500), number(0, 1));
    left_ = 2 + pick(6);
    while (left_ > 0) text += body(2);
    return text + "  </worldbody>\n</mujoco>\n";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() % 1000003) / 1000002;
  }
  std::string three(double low, double high) {
    return fmt::format("{} {} {}", number(low, high), number(low, high), number(low, high));
  }
  std::string turn() {
    const double full = degrees_ ? 180 : 3.14;
    switch (pick(6)) {
      case 0:
        return fmt::format(" quat=\"{} {}\"", number(0.2, 1), three(-1, 1));
      case 1:
        return fmt::format(" axisangle=\"{} {} {} {}\"", number(0.1, 1), number(-1, 1),
                           number(-1, 1), number(-full, full));
      case 2:
        return fmt::format(" xyaxes=\"1 {} {} {} 1 {}\"", number(-0.5, 0.5), number(-0.5, 0.5),
                           number(-0.5, 0.5), number(-0.5, 0.5));
      case 3:
        return fmt::format(" zaxis=\"{} {}\"", number(0.1, 1),
                           fmt::format("{} {}", number(-1, 1), number(-1, 1)));
      case 4:
        return fmt::format(" euler=\"{}\"", three(-full, full));
      default:
        return "";
    }
  }
  std::string geom() {
    const std::string mass = pick(2) == 0 ? fmt::format(" mass=\"{}\"", number(0.2, 3)) : "";
    const std::string place = fmt::format(" pos=\"{}\"{}", three(-0.2, 0.2), turn());
    switch (pick(6)) {
      case 0:
        return fmt::format("<geom size=\"{}\"{}{}/>", number(0.03, 0.2), place, mass);
      case 1:
        return fmt::format("<geom type=\"box\" size=\"{}\"{}{}/>", three(0.03, 0.2), place, mass);
      case 2:
        return fmt::format("<geom type=\"capsule\" size=\"{}\" fromto=\"0 0 0 {}\"{}/>",
                           number(0.03, 0.1), three(0.1, 0.3), mass);
      case 3:
        return fmt::format("<geom type=\"cylinder\" size=\"{} {}\"{}{}/>", number(0.03, 0.2),
                           number(0.05, 0.3), place, mass);
      case 4:
        return fmt::format("<geom type=\"ellipsoid\" size=\"{}\"{}{}/>", three(0.03, 0.2), place,
                           mass);
      default:
        return fmt::format("<geom type=\"box\" size=\"{}\" fromto=\"0 0 0 {}\"{}/>",
                           number(0.03, 0.1), three(0.1, 0.3), mass);
    }
  }
  std::string inertial() {
    const double mass = number(0.3, 4), a = number(0.01, 0.04), b = number(0.01, 0.04),
                 c = number(0.01, 0.04);
    return fmt::format("<inertial pos=\"{}\"{} mass=\"{}\" diaginertia=\"{} {} {}\"/>",
                       three(-0.2, 0.2), turn(), mass, a + b, a + c, b + c);
  }
  std::string joint() {
    const bool slider = pick(5) == 0;
    const double full = degrees_ && !slider ? 90 : 1;
    std::string text = fmt::format("<joint name=\"joint{}\"", ++joints_);
    if (slider) {
      text += " class=\"slider\"";
    } else {
      if (pick(2) == 0)
        text += fmt::format(" axis=\"{} {} {}\"", number(-1, 1), number(-1, 1), number(0.1, 1));
      if (pick(2) == 0) text += fmt::format(" pos=\"{}\"", three(-0.2, 0.2));
    }
    if (pick(3) == 0) text += fmt::format(" ref=\"{}\"", number(-full, full));
    if (pick(3) == 0) text += fmt::format(" damping=\"{}\"", number(0, 2));
    if (pick(3) == 0) text += fmt::format(" armature=\"{}\"", number(0, 0.5));
    if (pick(4) == 0) {
      text += fmt::format(" stiffness=\"{}\" springref=\"{}\"", number(1, 9), number(-full, full));
    }
    return text + "/>";
  }
  std::string body(int depth) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    --left_;
    std::string text =
        fmt::format("{}<body name=\"body{}\" pos=\"{}\"{}{}>\n", indent, ++bodies_,
                    three(-0.4, 0.4), turn(), pick(3) == 0 ? " childclass=\"arm\"" : "");
    const int kind = pick(5);
    const int joints = kind == 0 && joints_ > 0 ? 0 : kind == 1 ? 2 : 1;
    for (int i = 0; i < joints; ++i) text += indent + "  " + joint() + "\n";
    const bool by_geoms = geoms_alone_ || pick(2) == 0;
    if (!by_geoms) text += indent + "  " + inertial() + "\n";
    const int geoms = by_geoms ? 1 + pick(3) : pick(2);
    for (int i = 0; i < geoms; ++i) text += indent + "  " + geom() + "\n";
    while (left_ > 0 && pick(3) != 0) text += body(depth + 1);
    return text + indent + "</body>\n";
  }

  std::mt19937 random_;
  bool degrees_ = true, geoms_alone_ = false;
  int left_ = 0, bodies_ = 0, joints_ = 0;
};

}  // namespace

std::string made_mjcf(unsigned seed) { return MjcfMaker(seed).make(); }

}  // namespace dyngen::test
