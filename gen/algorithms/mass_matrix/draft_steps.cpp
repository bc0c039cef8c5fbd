// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/mass_matrix/draft_steps.h"

namespace dyngen {
namespace {

struct Pair {
  DraftValue x, y;
};

/// A sum as one factor of a product; twice a symbol stays open, since a known factor takes the two.
DraftValue as_factor(Draft& draft, const DraftName& name, const DraftValue& sum) {
  return sum.terms().size() > 1 ? draft.assign(name, sum) : sum;
}

/// Vectors and tensors in the plane of a turn, with the names of their components.
class TurnPlane {
 public:
  TurnPlane(Draft& draft, const DraftOwner& owner, const DraftTurn& turn)
      : draft_(draft), owner_(owner), turn_(turn) {}

  /// A vector given in the turned axes.
  Pair back(const char* stem_x, int x_number, const char* stem_y, int y_number,
            const Pair& v) const {
    return {assign(stem_x, x_number, turn_.cos * v.x - turn_.sin * v.y),
            assign(stem_y, y_number, turn_.sin * v.x + turn_.cos * v.y)};
  }
  /// A vector seen from the turned axes.
  Pair forth(const char* stem, int x_number, int y_number, const Pair& v) const {
    return {assign(stem, x_number, turn_.cos * v.x + turn_.sin * v.y),
            assign(stem, y_number, turn_.cos * v.y - turn_.sin * v.x)};
  }
  /// A symmetric tensor (xx, xy, yy) given in the turned axes:
  /// p = (xx - yy) c - 2 xy s, xx' = yy + c p, xy' = xy + s p, yy' = xx - c p.
  struct Tensor {
    DraftValue xx, xy, yy;
  };
  Tensor back(const char* xx, const char* xy, const char* yy, const Tensor& t) const {
    if (turn_.sin.is_zero()) return t;
    if (turn_.cos.is_zero()) return {t.yy, -t.xy, t.xx};  // a quarter turn
    const DraftValue difference = assign("JD", 0, t.xx - t.yy);
    const DraftValue twice = assign("JT", 0, 2 * t.xy);
    const DraftValue p = assign("JP", 0, difference * turn_.cos - twice * turn_.sin);
    const DraftValue cp = assign("JC", 0, p * turn_.cos);
    return {assign(xx, 0, t.yy + cp), assign(xy, 0, t.xy + p * turn_.sin),
            assign(yy, 0, t.xx - cp)};
  }

 private:
  [[nodiscard]] DraftValue assign(const char* stem, int number, const DraftValue& value) const {
    return draft_.assign({stem, number, owner_.first, owner_.second}, value);
  }

  Draft& draft_;
  DraftOwner owner_;
  DraftTurn turn_;
};

}  // namespace

DraftBody turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn, const DraftBody& b) {
  const TurnPlane plane(draft, owner, turn);
  DraftBody result = b;
  const auto tensor = plane.back("XXA", "XYA", "YYA", {b[Chi::kXX], b[Chi::kXY], b[Chi::kYY]});
  result[Chi::kXX] = tensor.xx;
  result[Chi::kXY] = tensor.xy;
  result[Chi::kYY] = tensor.yy;
  const Pair z = plane.back("XZA", 0, "YZA", 0, {b[Chi::kXZ], b[Chi::kYZ]});
  result[Chi::kXZ] = z.x;
  result[Chi::kYZ] = z.y;
  const Pair ms = plane.back("MXA", 0, "MYA", 0, {b[Chi::kMX], b[Chi::kMY]});
  result[Chi::kMX] = ms.x;
  result[Chi::kMY] = ms.y;
  return result;
}

DraftBody turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn, const DraftBody& b) {
  const TurnPlane plane(draft, owner, turn);
  DraftBody result = b;
  const auto tensor = plane.back("YYA", "YZA", "ZZA", {b[Chi::kYY], b[Chi::kYZ], b[Chi::kZZ]});
  result[Chi::kYY] = tensor.xx;
  result[Chi::kYZ] = tensor.xy;
  result[Chi::kZZ] = tensor.yy;
  const Pair x = plane.back("XYA", 0, "XZA", 0, {b[Chi::kXY], b[Chi::kXZ]});
  result[Chi::kXY] = x.x;
  result[Chi::kXZ] = x.y;
  const Pair ms = plane.back("MYA", 0, "MZA", 0, {b[Chi::kMY], b[Chi::kMZ]});
  result[Chi::kMY] = ms.x;
  result[Chi::kMZ] = ms.y;
  return result;
}

DraftWrench turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                   const DraftWrench& w) {
  const TurnPlane plane(draft, owner, turn);
  const Pair f = plane.back("FF", 1, "FF", 2, {w.force[0], w.force[1]});
  const Pair n = plane.back("FN", 1, "FN", 2, {w.moment[0], w.moment[1]});
  return {{f.x, f.y, w.force[2]}, {n.x, n.y, w.moment[2]}};
}

DraftWrench turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                   const DraftWrench& w) {
  const TurnPlane plane(draft, owner, turn);
  const Pair f = plane.back("FF", 2, "FF", 3, {w.force[1], w.force[2]});
  const Pair n = plane.back("FN", 2, "FN", 3, {w.moment[1], w.moment[2]});
  return {{w.force[0], f.x, f.y}, {w.moment[0], n.x, n.y}};
}

DraftScrew turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                  const DraftScrew& s) {
  const TurnPlane plane(draft, owner, turn);
  const Pair w = plane.forth("SW", 1, 2, {s.angular[0], s.angular[1]});
  const Pair v = plane.forth("SV", 1, 2, {s.linear[0], s.linear[1]});
  return {{w.x, w.y, s.angular[2]}, {v.x, v.y, s.linear[2]}};
}

DraftScrew turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                  const DraftScrew& s) {
  const TurnPlane plane(draft, owner, turn);
  const Pair w = plane.forth("SW", 2, 3, {s.angular[1], s.angular[2]});
  const Pair v = plane.forth("SV", 2, 3, {s.linear[1], s.linear[2]});
  return {{s.angular[0], w.x, w.y}, {s.linear[0], v.x, v.y}};
}

DraftBody slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r, const DraftBody& b) {
  if (r.is_zero()) return b;
  const auto assign = [&](const char* stem, const DraftValue& value) {
    return draft.assign({stem, 0, owner.first, owner.second}, value);
  };
  DraftBody result = b;
  result[Chi::kMZ] = assign("MZA", b[Chi::kMZ] + r * b[Chi::kM]);
  const DraftValue both =
      as_factor(draft, {"MZS", 0, owner.first, owner.second}, b[Chi::kMZ] + result[Chi::kMZ]);
  const DraftValue added = assign("JZ", r * both);
  result[Chi::kXX] = assign("XXA", b[Chi::kXX] + added);
  result[Chi::kYY] = assign("YYA", b[Chi::kYY] + added);
  result[Chi::kXZ] = assign("XZA", b[Chi::kXZ] - r * b[Chi::kMX]);
  result[Chi::kYZ] = assign("YZA", b[Chi::kYZ] - r * b[Chi::kMY]);
  return result;
}

DraftWrench slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r,
                    const DraftWrench& w) {
  DraftWrench result = w;
  result.moment[0] =
      draft.assign({"FN", 1, owner.first, owner.second}, w.moment[0] - r * w.force[1]);
  result.moment[1] =
      draft.assign({"FN", 2, owner.first, owner.second}, w.moment[1] + r * w.force[0]);
  return result;
}

DraftScrew slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r,
                   const DraftScrew& s) {
  DraftScrew result = s;
  result.linear[0] =
      draft.assign({"SV", 1, owner.first, owner.second}, s.linear[0] + r * s.angular[1]);
  result.linear[1] =
      draft.assign({"SV", 2, owner.first, owner.second}, s.linear[1] - r * s.angular[0]);
  return result;
}

DraftBody slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x, const DraftValue& y,
                   bool hinge, const DraftBody& b) {
  if (x.is_zero() && y.is_zero()) return b;
  const auto assign = [&](const char* stem, const DraftValue& value) {
    return draft.assign({stem, 0, owner.first, owner.second}, value);
  };
  DraftBody result = b;
  const DraftValue MX = assign("MXA", b[Chi::kMX] + x * b[Chi::kM]);
  const DraftValue MY = assign("MYA", b[Chi::kMY] + y * b[Chi::kM]);
  result[Chi::kMX] = MX;
  result[Chi::kMY] = MY;
  result[Chi::kXY] = assign("XYA", b[Chi::kXY] - x * MY - y * b[Chi::kMX]);
  result[Chi::kXZ] = assign("XZA", b[Chi::kXZ] - x * b[Chi::kMZ]);
  result[Chi::kYZ] = assign("YZA", b[Chi::kYZ] - y * b[Chi::kMZ]);
  // XX grows by y (MY + MY'), YY by x (MX + MX'), ZZ by both
  if (hinge) {
    const DraftValue ax = assign("JX", x * b[Chi::kMX]), ay = assign("JY", y * b[Chi::kMY]);
    const DraftValue bx = assign("JX", x * MX), by = assign("JY", y * MY);
    result[Chi::kXX] = assign("XXA", b[Chi::kXX] + ay + by);
    result[Chi::kYY] = assign("YYA", b[Chi::kYY] + ax + bx);
    const DraftValue half = assign("FN", b[Chi::kZZ] + assign("JS", ax + ay));
    result[Chi::kZZ] = assign("ZZA", half + assign("JS", bx + by));
    return result;
  }
  const auto grown = [&](const char* stem, const char* sum_stem, const DraftValue& length,
                         const DraftValue& sum) {
    return assign(stem, length * as_factor(draft, {sum_stem, 0, owner.first, owner.second}, sum));
  };
  const DraftValue ax = grown("JX", "MXS", x, b[Chi::kMX] + MX);
  const DraftValue ay = grown("JY", "MYS", y, b[Chi::kMY] + MY);
  result[Chi::kXX] = assign("XXA", b[Chi::kXX] + ay);
  result[Chi::kYY] = assign("YYA", b[Chi::kYY] + ax);
  result[Chi::kZZ] = assign("ZZA", b[Chi::kZZ] + ax + ay);
  return result;
}

DraftWrench slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x,
                     const DraftValue& y, const DraftWrench& w) {
  const auto assign = [&](int component, const DraftValue& value) {
    return draft.assign({"FN", component, owner.first, owner.second}, value);
  };
  const DraftVector& f = w.force;
  const DraftValue about_z =
      draft.assign({"FT", 0, owner.first, owner.second}, x * f[1] - y * f[0]);
  return {f,
          {assign(1, w.moment[0] + y * f[2]), assign(2, w.moment[1] - x * f[2]),
           assign(3, w.moment[2] + about_z)}};
}

DraftScrew slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x, const DraftValue& y,
                    const DraftScrew& s) {
  const auto assign = [&](int component, const DraftValue& value) {
    return draft.assign({"SV", component, owner.first, owner.second}, value);
  };
  const DraftVector& w = s.angular;
  return {w,
          {assign(1, s.linear[0] - y * w[2]), assign(2, s.linear[1] + x * w[2]),
           assign(3, s.linear[2] + y * w[0] - x * w[1])}};
}

DraftWrench unit_wrench(const DraftBody& body, bool revolute) {
  if (revolute) {
    return {{-body[Chi::kMY], body[Chi::kMX], 0}, {body[Chi::kXZ], body[Chi::kYZ], body[Chi::kZZ]}};
  }
  return {{0, 0, body[Chi::kM]}, {body[Chi::kMY], -body[Chi::kMX], 0}};
}

DraftValue work(const DraftScrew& screw, const DraftWrench& wrench) {
  DraftValue sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += screw.angular[k] * wrench.moment[k] + screw.linear[k] * wrench.force[k];
  }
  return sum;
}

}  // namespace dyngen
