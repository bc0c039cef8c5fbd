// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/base_parameters/numeric_regressor.h"

#include <cln/float.h>
#include <cln/real.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

template <class T>
using NumericVector = std::array<T, 3>;

template <class T>
T number(const GiNaC::ex& value) {
  const GiNaC::ex approximate = value.evalf();
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::numeric>(approximate), "a length has no number");
  const GiNaC::numeric real = GiNaC::ex_to<GiNaC::numeric>(approximate).real();
  if constexpr (std::is_same_v<T, long double>) {
    // two doubles carry what one would round away
    const double high = real.to_double();
    return static_cast<long double>(high) +
           static_cast<long double>((real - GiNaC::numeric(high)).to_double());
  } else {
    return cln::the<cln::cl_R>(real.to_cl_N());
  }
}

template <class T>
NumericVector<T> cross(const NumericVector<T>& a, const NumericVector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
NumericVector<T> sum(const NumericVector<T>& a, const NumericVector<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Where a link's frame stands in its parent's: Rx(alpha) Rz(theta + q) and the origin.
template <class T>
struct Pose {
  T ca, sa, c, s;
  NumericVector<T> p;

  NumericVector<T> to_child(const NumericVector<T>& v) const {
    const T y = ca * v[1] + sa * v[2];
    return {c * v[0] + s * y, c * y - s * v[0], ca * v[2] - sa * v[1]};
  }
  NumericVector<T> to_parent(const NumericVector<T>& v) const {
    const T y = s * v[0] + c * v[1];
    return {c * v[0] - s * v[1], ca * y - sa * v[2], sa * y + ca * v[2]};
  }
};

template <class T>
struct LinkState {
  Pose<T> pose;
  NumericVector<T> w, wp,
      vp;  // angular velocity, its derivative, acceleration of the origin less gravity
};

template <class T>
std::vector<LinkState<T>> link_states(const NumericGeometry<T>& geometry,
                                      const RandomState& state) {
  using std::cos;
  using std::sin;
  const T zero = T(0);
  std::vector<LinkState<T>> links(geometry.links.size() + 1);
  links[0].w = links[0].wp = {zero, zero, zero};
  links[0].vp = {geometry.gravity[0], geometry.gravity[1], geometry.gravity[2]};
  for (std::size_t j = 1; j < links.size(); ++j) {
    const auto& link = geometry.links[j - 1];
    const LinkState<T>& parent = links[static_cast<std::size_t>(link.parent)];
    LinkState<T>& own = links[j];
    const auto coordinate = static_cast<std::size_t>(link.coordinate < 0 ? 0 : link.coordinate);
    const bool moves = link.type != JointType::kFixed;
    const T q = moves ? number<T>(state.q[coordinate]) : zero;
    const T dq = moves ? number<T>(state.dq[coordinate]) : zero;
    const T ddq = moves ? number<T>(state.ddq[coordinate]) : zero;
    own.pose.ca = link.cos_alpha;
    own.pose.sa = link.sin_alpha;
    own.pose.c = link.cos_theta;
    own.pose.s = link.sin_theta;
    T along = link.r;
    if (link.type == JointType::kRevolute) {
      const T cq = T(cos(q)), sq = T(sin(q));
      own.pose.c = link.cos_theta * cq - link.sin_theta * sq;
      own.pose.s = link.sin_theta * cq + link.cos_theta * sq;
    } else if (link.type == JointType::kPrismatic) {
      along = along + q;
    }
    own.pose.p = {link.d, -along * link.sin_alpha, along * link.cos_alpha};
    const NumericVector<T>& p = own.pose.p;
    const NumericVector<T> carried =
        sum(sum(parent.vp, cross(parent.wp, p)), cross(parent.w, cross(parent.w, p)));
    own.w = own.pose.to_child(parent.w);
    own.wp = own.pose.to_child(parent.wp);
    own.vp = own.pose.to_child(carried);
    if (link.type == JointType::kRevolute) {
      own.wp = sum(own.wp, {own.w[1] * dq, -own.w[0] * dq, ddq});
      own.w[2] = own.w[2] + dq;
    } else if (link.type == JointType::kPrismatic) {
      const T two = T(2);
      own.vp = sum(own.vp, {two * own.w[1] * dq, -two * own.w[0] * dq, ddq});
    }
  }
  return links;
}

template <class T>
struct Wrench {
  NumericVector<T> force, moment;
};

/// Force and moment about the origin that the link needs for a unit of one parameter.
template <class T>
Wrench<T> unit_wrench(Chi kind, const LinkState<T>& link) {
  const T zero = T(0);
  const T one = T(1);
  NumericVector<T> force = {zero, zero, zero}, moment = {zero, zero, zero};
  if (kind == Chi::kM) {
    force = link.vp;
  } else if (kind == Chi::kMX || kind == Chi::kMY || kind == Chi::kMZ) {
    NumericVector<T> s = {zero, zero, zero};
    s[index(kind) - index(Chi::kMX)] = one;
    force = sum(cross(link.wp, s), cross(link.w, cross(link.w, s)));
    moment = cross(s, link.vp);
  } else {
    constexpr std::array<std::array<std::size_t, 2>, 6> kPlaces = {
        {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
    const std::size_t a = kPlaces[index(kind)][0], b = kPlaces[index(kind)][1];
    const auto times = [&](const NumericVector<T>& v) {
      NumericVector<T> result = {zero, zero, zero};
      result[a] = v[b];
      result[b] = v[a];
      return result;
    };
    moment = sum(times(link.wp), cross(link.w, times(link.w)));
  }
  return {force, moment};
}

}  // namespace

GiNaC::numeric RandomStream::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  const long odd = static_cast<long>(z >> 31) | 1L;  // 33 bits, never 0
  return GiNaC::numeric(odd) / GiNaC::numeric(4294967296L) - 1;
}

RandomState random_state(const SymbolicRobot& robot, RandomStream& random, bool moving) {
  RandomState state;
  for (int i = 0; i < robot.coordinate_count; ++i) {
    state.q.push_back(random.next() * 3);
    state.dq.push_back(moving ? random.next() * 3 : GiNaC::numeric(0));
    state.ddq.push_back(moving ? random.next() * 5 : GiNaC::numeric(0));
  }
  return state;
}

template <class T>
NumericGeometry<T> numeric_geometry(const SymbolicRobot& robot, const GiNaC::exmap& lengths) {
  NumericGeometry<T> geometry;
  for (const SymbolicLink& link : robot.links) {
    geometry.links.push_back({link.type, link.parent, link.coordinate,
                              number<T>(exact_cos(link.alpha)), number<T>(exact_sin(link.alpha)),
                              number<T>(exact_cos(link.theta)), number<T>(exact_sin(link.theta)),
                              number<T>(link.d.subs(lengths)), number<T>(link.r.subs(lengths))});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    geometry.gravity[k] = number<T>(robot.gravity[k].subs(lengths));
  }
  return geometry;
}

template <class T>
std::vector<std::vector<T>> numeric_regressor(const NumericGeometry<T>& geometry,
                                              const RandomState& state,
                                              const std::vector<Column>& columns) {
  const std::vector<LinkState<T>> links = link_states(geometry, state);
  std::vector<std::vector<T>> rows(state.q.size(), std::vector<T>(columns.size(), T(0)));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Column column = columns[k];
    if (column.kind == Chi::kIA) {
      const int own = geometry.links[static_cast<std::size_t>(column.link - 1)].coordinate;
      DYNGEN_ASSERT(own >= 0, "a fixed joint has no rotor");
      rows[static_cast<std::size_t>(own)][k] = number<T>(state.ddq[static_cast<std::size_t>(own)]);
      continue;
    }
    Wrench<T> wrench = unit_wrench(column.kind, links[static_cast<std::size_t>(column.link)]);
    for (int j = column.link; j > 0; j = geometry.links[static_cast<std::size_t>(j - 1)].parent) {
      const auto& link = geometry.links[static_cast<std::size_t>(j - 1)];
      if (link.type == JointType::kRevolute) {
        rows[static_cast<std::size_t>(link.coordinate)][k] = wrench.moment[2];
      } else if (link.type == JointType::kPrismatic) {
        rows[static_cast<std::size_t>(link.coordinate)][k] = wrench.force[2];
      }
      const Pose<T>& pose = links[static_cast<std::size_t>(j)].pose;
      wrench.force = pose.to_parent(wrench.force);
      wrench.moment = sum(pose.to_parent(wrench.moment), cross(pose.p, wrench.force));
    }
  }
  return rows;
}

template NumericGeometry<long double> numeric_geometry(const SymbolicRobot&, const GiNaC::exmap&);
template NumericGeometry<cln::cl_R> numeric_geometry(const SymbolicRobot&, const GiNaC::exmap&);
template std::vector<std::vector<long double>> numeric_regressor(
    const NumericGeometry<long double>&, const RandomState&, const std::vector<Column>&);
template std::vector<std::vector<cln::cl_R>> numeric_regressor(const NumericGeometry<cln::cl_R>&,
                                                               const RandomState&,
                                                               const std::vector<Column>&);

}  // namespace dyngen
