// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/bodies/moving_body.h"

#include <fmt/format.h>

#include "gen/algorithms/bodies/link_wrench.h"

namespace dyngen {
namespace {

using GiNaC::ex;

Matrix3 full(const Tensor& T) {
  return {{{T[kXX], T[kXY], T[kXZ]}, {T[kXY], T[kYY], T[kYZ]}, {T[kXZ], T[kYZ], T[kZZ]}}};
}

Tensor symmetric(const Matrix3& A) {
  return {A[0][0], A[0][1], A[0][2], A[1][1], A[1][2], A[2][2]};
}

/// The plane in which a rotation turns.
struct Plane {
  std::size_t i = 0, k = 1;
};

void turn(const Plane& plane, const ex& s, const ex& c, Vector3& v) {
  const ex x = v[plane.i], y = v[plane.k];
  v[plane.i] = c * x - s * y;
  v[plane.k] = s * x + c * y;
}

/// R A R^T of a matrix in which only the rows and columns of the plane change. @param name  of the
/// help variables
void turn(Trace& trace, const std::string& name, const Plane& plane, const ex& s, const ex& c,
          Matrix3& A) {
  const auto [i, k] = plane;
  const std::size_t o = 3 - i - k;  // the axis
  Vector3 row = A[o], column = {A[0][o], A[1][o], A[2][o]};
  turn(plane, s, c, row);
  turn(plane, s, c, column);
  const ex a = A[i][i], b = A[i][k], b2 = A[k][i], d = A[k][k];
  if (s.is_zero() || c.is_zero()) {  // by right angles
    const ex ss = s * s, cc = c * c;
    A[i][i] = cc * a + ss * d;
    A[k][k] = ss * a + cc * d;
    A[i][k] = cc * b - ss * b2;
    A[k][i] = cc * b2 - ss * b;
  } else {
    const ex difference = trace.assign(name + "D", a - d);
    const ex sum = trace.assign(name + "S", b + b2);
    const ex shared = trace.assign(name, s * difference + c * sum);
    const ex delta = trace.assign(name + "SS", s * shared);
    const ex across = trace.assign(name + "CS", c * shared);
    A[i][i] = a - delta;
    A[k][k] = d + delta;
    A[i][k] = across - b2;
    A[k][i] = across - b;
  }
  A[o][i] = row[i];
  A[o][k] = row[k];
  A[i][o] = column[i];
  A[k][o] = column[k];
}

MovingBody turned(Trace& trace, const BodyName& name, const Plane& plane, const ex& s, const ex& c,
                  const MovingBody& body) {
  if (s.is_zero() && c.is_equal(1)) return body;
  const auto label = [&](const char* quantity) {
    return fmt::format("{}{}_{}", name.mark, quantity, name.link);
  };
  MovingBody result = body;
  Matrix3 K = full(body.K);
  turn(trace, label("K"), plane, s, c, K);
  result.K = symmetric(K);
  turn(trace, label("G"), plane, s, c, result.G);
  for (Vector3* v : {&result.h, &result.p, &result.f, &result.n}) turn(plane, s, c, *v);
  return assigned(trace, name, result);
}

/// K = tr(J)/2 I - J
Tensor euler_tensor(Trace& trace, const BodyName& name, const LinkInertia& inertia) {
  const Tensor& T = inertia.tensor;
  if (inertia.euler_tensor) return T;
  const auto assign = [&](const char* element, const ex& value) {
    return trace.assign(fmt::format("{}K{}_{}", name.mark, element, name.link), value);
  };
  const ex xx = assign("XX", (T[kYY] + T[kZZ] - T[kXX]) / 2);
  return {xx, -T[kXY], -T[kXZ], assign("YY", T[kZZ] - xx), -T[kYZ], assign("ZZ", T[kYY] - xx)};
}

}  // namespace

MovingBody write_standing_body(Trace& trace, const BodyName& name, const LinkInertia& inertia) {
  MovingBody body;
  body.K = euler_tensor(trace, name, inertia);
  body.h = inertia.MS;
  body.m = inertia.M;
  return body;
}

MovingBody write_rigid_body(Trace& trace, const BodyName& name, const LinkInertia& inertia,
                            const LinkMotion& motion, int rates) {
  MovingBody body = write_standing_body(trace, name, inertia);
  Vector3 twice;  // the angular velocity
  for (std::size_t k = 0; k < 3; ++k) twice[k] = rates * motion.W[k];
  twice = assign_vector(trace, name.mark + "W2", name.link, twice);
  const Matrix3 K = full(body.K);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 column = cross(twice, {K[0][k], K[1][k], K[2][k]});
    for (std::size_t i = 0; i < 3; ++i) body.G[i][k] = column[i];
  }
  body.p = cross(twice, body.h);
  body.f = link_force(inertia, motion);
  body.n = link_moment(trace, name.mark, name.link, inertia, motion);
  return body;
}

void add(MovingBody& sum, const MovingBody& more) {
  for (std::size_t k = 0; k < 6; ++k) sum.K[k] += more.K[k];
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) sum.G[i][k] += more.G[i][k];
    sum.h[k] += more.h[k];
    sum.p[k] += more.p[k];
    sum.f[k] += more.f[k];
    sum.n[k] += more.n[k];
  }
  sum.m += more.m;
}

MovingBody assigned(Trace& trace, const BodyName& name, const MovingBody& body) {
  constexpr std::array<const char*, 6> kNames = {"XX", "XY", "XZ", "YY", "YZ", "ZZ"};
  MovingBody result;
  const auto assign = [&](const std::string& quantity, const ex& value) {
    return trace.assign(fmt::format("{}{}_{}", name.mark, quantity, name.link), value);
  };
  for (std::size_t k = 0; k < 6; ++k) {
    result.K[k] = assign(std::string("K") + kNames[k], body.K[k]);
  }
  result.m = assign("M", body.m);
  const auto vector = [&](const char* quantity, const Vector3& v) {
    return assign_vector(trace, name.mark + quantity, name.link, v);
  };
  result.h = vector("H", body.h);
  for (std::size_t i = 0; i < 3; ++i) {
    result.G[i] = vector(("G" + std::to_string(i + 1)).c_str(), body.G[i]);
  }
  result.p = vector("P", body.p);
  result.f = vector("E", body.f);
  result.n = vector("T", body.n);
  return result;
}

MovingBody turned_about_z(Trace& trace, const BodyName& name, const FrameRotation& rotation,
                          const MovingBody& body) {
  return turned(trace, name, {0, 1}, rotation.sin_angle, rotation.cos_angle, body);
}

MovingBody turned_about_x(Trace& trace, const BodyName& name, const FrameRotation& rotation,
                          const MovingBody& body) {
  return turned(trace, name, {1, 2}, rotation.sin_alpha, rotation.cos_alpha, body);
}

Matrix3 turned_about_z(Trace& trace, const std::string& name, const FrameRotation& rotation,
                       const Matrix3& tensor) {
  Matrix3 result = tensor;
  turn(trace, name, {0, 1}, rotation.sin_angle, rotation.cos_angle, result);
  return result;
}

Matrix3 turned_about_x(Trace& trace, const std::string& name, const FrameRotation& rotation,
                       const Matrix3& tensor) {
  Matrix3 result = tensor;
  turn(trace, name, {1, 2}, rotation.sin_alpha, rotation.cos_alpha, result);
  return result;
}

MovingBody moved(const PointStep& step, const MovingBody& body) {
  const auto& [P, V2] = step;
  MovingBody result = body;
  for (std::size_t k = 0; k < 3; ++k) {
    result.h[k] += body.m * P[k];
    result.p[k] += body.m * V2[k];
  }
  Matrix3 K = full(body.K);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      K[i][k] += body.h[i] * P[k] + P[i] * result.h[k];
      result.G[i][k] += body.p[i] * P[k] + V2[i] * result.h[k];
    }
  }
  result.K = symmetric(K);
  const Vector3 lever = cross(P, body.f);
  for (std::size_t k = 0; k < 3; ++k) result.n[k] += lever[k];
  return result;
}

}  // namespace dyngen
