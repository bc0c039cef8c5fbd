// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/regressors/link_regressor.h"

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>

namespace dyngen {
namespace {

using GiNaC::ex;

ex dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 column(const Matrix3& U, std::size_t k) { return {U[0][k], U[1][k], U[2][k]}; }

Chi first_moment(std::size_t k) { return static_cast<Chi>(index(Chi::kMX) + k); }

/// The first of those with the fewest operations.
ex cheapest(const Trace& trace, std::initializer_list<ex> values) {
  const ex* best = nullptr;
  int least = 0;
  for (const ex& value : values) {
    const int own = count_operations(canonical_form(value, trace.symbols())).total();
    if (best != nullptr && own >= least) continue;
    best = &value;
    least = own;
  }
  return *best;
}

/// Writes one joint's row.
class RowWriter {
 public:
  RowWriter(Trace& trace, const CarriedLink& link, const JointScrew& screw)
      : trace_(trace), link_(link), motion_(*link.motion), screw_(screw), a_(screw.a) {
    row_.fill(0);
  }

  InertialRow leader() {
    if (!is_zero(a_)) {
      write_axial();
      write_products();
    }
    write_first_moments();
    return row_;
  }

  InertialRow follower(const InertialRow& leader) {
    for (std::size_t k = 0; k < kInertialCount; ++k) row_[k] = screw_.sign * leader[k];
    add_forces({at(Chi::kMX), at(Chi::kMY), at(Chi::kMZ)});
    set(Chi::kM, at(Chi::kM) + dot(screw_.b, motion_.VP));
    return row_;
  }

 private:
  [[nodiscard]] const ex& at(Chi kind) const { return row_[index(kind)]; }
  [[nodiscard]] bool wants(Chi kind) const { return link_.wanted[index(kind)]; }

  void set(Chi kind, const ex& value) {
    if (!wants(kind)) return;
    row_[index(kind)] = trace_.assign(
        fmt::format("Y{}_{}{}", screw_.joint, kChiNames[index(kind)], link_.link), value);
  }

  /// (a x W) z, with the motion of the link or of the frame below.
  ex write_spin() {
    ex here = a_[0] * motion_.W[1] - a_[1] * motion_.W[0];
    const JointScrew* below = link_.anchor_screws->find(screw_.joint);
    if (below == nullptr) return here;
    const FrameRotation& r = link_.frame->from_anchor;
    const Vector3 spin = cross(below->a, link_.anchor_motion->W);
    return cheapest(trace_, {r.cos_alpha * spin[2] - r.sin_alpha * spin[1], here});
  }

  /// XX, YY, ZZ
  void write_axial() {
    const Vector3& WP = motion_.WP;
    const Vector3& WW = motion_.WW;
    const Matrix3& U = motion_.U;
    spin_ = write_spin();
    set(Chi::kZZ,
        a_[2] * WP[2] + cheapest(trace_, {motion_.W[2] * spin_, a_[0] * WW[0] - a_[1] * WW[1]}));
    const ex xx = a_[0] * WP[0] + a_[1] * WW[1] - a_[2] * WW[2];
    const ex xx_and_zz = a_[0] * U[2][1] - a_[2] * U[0][1];
    set(Chi::kXX, wants(Chi::kZZ) ? cheapest(trace_, {xx_and_zz - at(Chi::kZZ), xx}) : xx);
    const ex yy = a_[1] * WP[1] + a_[2] * WW[2] - a_[0] * WW[0];
    const ex xx_and_yy = a_[1] * U[0][2] - a_[0] * U[1][2];
    set(Chi::kYY, wants(Chi::kXX) ? cheapest(trace_, {xx_and_yy - at(Chi::kXX), yy}) : yy);
  }

  /// XY, XZ, YZ
  void write_products() {
    const Matrix3& U = motion_.U;
    const Vector3& D = motion_.D;
    set(Chi::kXY, a_[1] * U[2][1] - a_[0] * U[2][0] + a_[2] * D[2]);
    if (a_[2].is_zero() && spin_.is_zero()) {
      const ex square =
          trace_.assign(fmt::format("DV33_{}", link_.link), motion_.W[2] * motion_.W[2]);
      set(Chi::kXZ, a_[0] * motion_.WP[2] + a_[1] * square);
      set(Chi::kYZ, a_[1] * motion_.WP[2] - a_[0] * square);
      return;
    }
    set(Chi::kXZ, a_[0] * U[1][0] + a_[1] * D[1] - a_[2] * U[1][2]);
    set(Chi::kYZ, a_[0] * D[0] - a_[1] * U[0][1] + a_[2] * U[0][2]);
  }

  /// MX, MY, MZ, M
  void write_first_moments() {
    if (link_.about_center.contains(screw_.center)) {
      const Vector3& arm = link_.screws->centers.at(screw_.center);
      for (std::size_t k = 0; k < 3; ++k) {
        if (wants(first_moment(k))) set(first_moment(k), dot(a_, moment_about(arm, k)));
      }
      set(Chi::kM, dot(a_, write_vector("N", "M", cross(arm, motion_.VP))));
      return;
    }
    const bool weightless = link_.stands && link_.along_gravity.contains(screw_.joint);
    const Vector3 lever = weightless ? Vector3{0, 0, 0} : cross(motion_.VP, a_);
    add_forces(lever);
    set(Chi::kM, dot(screw_.b, motion_.VP));
  }

  /// The forces U e of unit first moments on the joint's b.
  void add_forces(const Vector3& lever) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!wants(first_moment(k))) continue;
      Vector3 force = column(motion_.U, k);
      const Vector3* b = &screw_.b;
      if (link_.force_below && screw_.b_below) {
        const std::string parameter(kChiNames[index(first_moment(k))]);
        const std::string help = fmt::format("FA{}_{}", parameter, link_.link);
        force = to_parent(trace_, help, link_.frame->rotation, force);
        for (std::size_t i = 0; i < 3; ++i) {
          force[i] =
              trace_.assign(fmt::format("FB{}{}_{}", i + 1, parameter, link_.link), force[i]);
        }
        b = &*screw_.b_below;
      }
      set(first_moment(k), lever[k] + dot(*b, force));
    }
  }

  /// Of a unit first moment along an axis of the link, about a point so far below the origin.
  Vector3 moment_about(const Vector3& arm, std::size_t k) {
    Vector3 axis = {0, 0, 0};
    axis[k] = 1;
    const Vector3 about_origin = cross(axis, motion_.VP);
    Vector3 moment = cross(arm, column(motion_.U, k));
    for (std::size_t i = 0; i < 3; ++i) moment[i] += about_origin[i];
    return write_vector("N", kChiNames[index(first_moment(k))], moment);
  }

  Vector3 write_vector(const char* quantity, std::string_view parameter, const Vector3& v) {
    Vector3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = trace_.assign(
          fmt::format("{}{}{}_{}_{}", quantity, i + 1, parameter, screw_.center, link_.link), v[i]);
    }
    return result;
  }

  Trace& trace_;
  const CarriedLink& link_;
  const LinkMotion& motion_;
  const JointScrew& screw_;
  const Vector3& a_;
  InertialRow row_;
  ex spin_ = 0;
};

}  // namespace

std::map<int, InertialRow> write_link_regressor(Trace& trace, const CarriedLink& link) {
  std::map<int, InertialRow> rows;
  for (auto screw = link.screws->joints.rbegin(); screw != link.screws->joints.rend(); ++screw) {
    RowWriter writer(trace, link, *screw);
    rows[screw->joint] = screw->leads() ? writer.leader() : writer.follower(rows.at(screw->leader));
  }
  return rows;
}

}  // namespace dyngen
