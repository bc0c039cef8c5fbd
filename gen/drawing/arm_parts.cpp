// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/drawing/arm_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dyngen {
namespace {

/// Collects the parts; bodies of joints are kept apart from each other.
class Builder {
 public:
  Builder(const Posture& posture, const Vec3& up) : posture_(posture), up_(up) {
    parts_.size = extent();
    add_ground();
    for (int j = 1; j <= count(); ++j) add_joint(j);
    for (int j = 1; j <= count(); ++j) {
      if (is_leaf(j)) add_end(j);
    }
    for (int j = 0; j <= count(); ++j) add_frame(j);
  }

  ArmParts take() { return std::move(parts_); }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(posture_.links.size()); }
  [[nodiscard]] double nothing() const { return 1e-7 * parts_.size; }
  [[nodiscard]] bool same(const Vec3& a, const Vec3& b) const { return norm(a - b) < nothing(); }

  [[nodiscard]] bool is_leaf(int j) const {
    return std::none_of(posture_.links.begin(), posture_.links.end(),
                        [&](const PosedLink& link) { return link.parent == j; });
  }

  /// The diagonal of the box around the arm.
  [[nodiscard]] double extent() const {
    Vec3 low, high;
    const auto hold = [&](const Vec3& point) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
    };
    for (const PosedLink& link : posture_.links) {
      for (const Vec3& point : {link.foot, link.frame.origin, link.tip.origin}) hold(point);
    }
    const double diagonal = norm(high - low);
    return diagonal > 1e-9 ? diagonal : 1;
  }

  /// The base stands on the ground at O0 where the first link leads away from it, else a column
  /// above it.
  void add_ground() {
    const PosedLink& first = posture_.link(1);
    const double along = dot(first.frame.z, up_);
    parts_.ground.normal =
        std::abs(along) > 0.5 ? (along > 0 ? first.frame.z : -first.frame.z) : up_;
    const double height = dot(first.frame.origin, parts_.ground.normal);
    if (height < -nothing()) parts_.ground.normal = -parts_.ground.normal;
    if (std::abs(height) > nothing()) return;
    if (is_below_origin()) parts_.ground.normal = -parts_.ground.normal;  // it hangs
    parts_.ground.centre = -(0.2 * parts_.size) * parts_.ground.normal;
    column_ = true;
  }

  /// Whether a link stands where the column would.
  [[nodiscard]] bool is_below_origin() const {
    const Vec3& normal = parts_.ground.normal;
    return std::any_of(posture_.links.begin(), posture_.links.end(), [&](const PosedLink& link) {
      const Vec3& origin = link.frame.origin;
      return dot(origin, normal) < -nothing() && norm(cross(origin, normal)) < nothing();
    });
  }

  [[nodiscard]] bool is_free(const Vec3& centre) const {
    return std::none_of(parts_.bodies.begin(), parts_.bodies.end(),
                        [&](const ArmParts::Body& body) {
                          return norm(body.centre - centre) < 1.05 * parts_.body_length();
                        });
  }

  /// A place on the axis of joint j: on the link if it runs along the axis, at the origin, or
  /// beside it.
  [[nodiscard]] Vec3 body_place(int j) const {
    const PosedLink& link = posture_.link(j);
    const Vec3 &origin = link.frame.origin, &z = link.frame.z;
    std::vector<Vec3> places;
    if (norm(origin - link.foot) > 1.15 * parts_.body_length()) {
      places.push_back(0.5 * (origin + link.foot));
    }
    const bool upright = norm(cross(z, parts_.ground.normal)) < 1e-6;
    if (j == 1 && column_ && upright) places.push_back(0.45 * parts_.ground.centre);
    places.push_back(origin);
    for (const double step : {1.1, -1.1, 2.2, -2.2, 3.3, -3.3}) {
      places.push_back(origin + step * parts_.body_length() * z);
    }
    const auto found = std::find_if(places.begin(), places.end(),
                                    [&](const Vec3& place) { return is_free(place); });
    return found == places.end() ? origin : *found;
  }

  void add_rod(const Vec3& from, const Vec3& to, int link) {
    if (!same(from, to)) parts_.rods.push_back({from, to, link, false});
  }

  void add_joint(int j) {
    const PosedLink& link = posture_.link(j);
    const Vec3 centre = body_place(j);
    const Vec3& origin = link.frame.origin;
    if (j == 1 && column_) {
      const bool inside = dot(centre, parts_.ground.normal) < -nothing();
      add_rod(parts_.ground.centre, inside ? centre : Vec3{}, 0);
      if (inside) add_rod(centre, {}, 1);
    }
    add_rod(posture_.frame(link.parent).origin, link.foot, link.parent);
    const double reach = dot(origin - link.foot, link.frame.z);
    const double place = dot(centre - link.foot, link.frame.z);
    const bool between = place * reach > 0 && std::abs(place) < std::abs(reach);
    add_rod(link.foot, between ? centre : origin, link.parent);
    const bool in_column = j == 1 && dot(centre, parts_.ground.normal) < -nothing();
    if (!in_column) add_rod(centre, origin, j);
    parts_.bodies.push_back({j, centre});
  }

  /// The way on from the end of a link whose length the file does not say.
  [[nodiscard]] Vec3 way_on(int j) const {
    const Frame& frame = posture_.link(j).frame;
    const Vec3 before = posture_.frame(posture_.link(j).parent).z;
    const Vec3 way = norm(cross(frame.z, before)) < 1e-6 ? frame.x : frame.z;
    for (const ArmParts::Rod& rod : parts_.rods) {
      for (const auto& [end, other] : {std::pair(rod.from, rod.to), std::pair(rod.to, rod.from)}) {
        if (rod.link != j && same(end, frame.origin) && dot(unit(other - end), way) > 0.99) {
          return -way;
        }
      }
    }
    return way;
  }

  void add_end(int j) {
    const PosedLink& link = posture_.link(j);
    add_rod(link.frame.origin, link.tip.origin, j);
    const bool has_length =
        !same(link.frame.origin, link.foot) || !same(link.frame.origin, link.tip.origin);
    if (has_length || link.type != JointType::kRevolute) {
      parts_.tools.push_back(link.tip.origin);
      return;
    }
    const Vec3 end = link.frame.origin + 0.3 * parts_.size * way_on(j);
    parts_.rods.push_back({link.frame.origin, end, j, true});
  }

  void add_arrow(const Vec3& from, const Vec3& direction, char axis, int frame) {
    for (ArmParts::Arrow& arrow : parts_.arrows) {
      if (arrow.axis != axis || !same(arrow.from, from)) continue;
      if (norm(arrow.direction - direction) > 1e-6) continue;
      arrow.frames.push_back(frame);
      return;
    }
    parts_.arrows.push_back({from, direction, axis, {frame}});
  }

  void add_frame(int j) {
    const Frame frame = posture_.frame(j);
    add_arrow(frame.origin, frame.x, 'x', j);
    add_arrow(frame.origin, frame.y, 'y', j);
    add_arrow(frame.origin, frame.z, 'z', j);
  }

  const Posture& posture_;
  Vec3 up_;
  ArmParts parts_;
  bool column_ = false;
};

}  // namespace

ArmParts arm_parts(const Posture& posture, const Vec3& up) { return Builder(posture, up).take(); }

}  // namespace dyngen
