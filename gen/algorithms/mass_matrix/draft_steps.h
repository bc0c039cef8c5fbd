// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>

#include "gen/model/chi.h"
#include "gen/trace/draft.h"

/// A link's transform Rx(alpha) Tx(d) Rz(theta) Tz(r) taken in single steps, each of which keeps
/// most of what it moves: bodies and wrenches go from the link to its parent, screws from the
/// parent to the link.
namespace dyngen {

using DraftVector = std::array<DraftValue, 3>;

/// Ten parameters of a body about a point, in the order of chi: XX XY XZ YY YZ ZZ MX MY MZ M.
struct DraftBody {
  std::array<DraftValue, kInertialCount> chi;

  [[nodiscard]] const DraftValue& operator[](Chi kind) const { return chi[index(kind)]; }
  [[nodiscard]] DraftValue& operator[](Chi kind) { return chi[index(kind)]; }
};

/// Force, and moment about a point.
struct DraftWrench {
  DraftVector force;
  DraftVector moment;
};

/// Motion of a body per unit of a joint's rate: angular, and linear of a point.
struct DraftScrew {
  DraftVector angular;
  DraftVector linear;
};

/// Whose statements these are.
struct DraftOwner {
  int first = 0;   ///< the link, or the joint that moves
  int second = 0;  ///< the link that it is carried to; 0 for a composite body
};

/// A turn by an angle of which sine and cosine are known.
struct DraftTurn {
  DraftValue sin = 0;
  DraftValue cos = 1;
};

/// Axes turned back about z: the vector is given in the turned axes.
DraftBody turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn, const DraftBody& b);
DraftWrench turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                   const DraftWrench& w);
/// Axes turned back about x.
DraftBody turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn, const DraftBody& b);
DraftWrench turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                   const DraftWrench& w);
/// The reverse: the screw is given in the axes before the turn.
DraftScrew turn_z(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                  const DraftScrew& s);
DraftScrew turn_x(Draft& draft, const DraftOwner& owner, const DraftTurn& turn,
                  const DraftScrew& s);

/// About the point that the present one sees at -r z.
DraftBody slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r, const DraftBody& b);
DraftWrench slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r,
                    const DraftWrench& w);
/// The reverse: of the point at r z.
DraftScrew slide_z(Draft& draft, const DraftOwner& owner, const DraftValue& r, const DraftScrew& s);

/// About the point that the present one sees at -(x, y, 0).
/// @param hinge  the body turns about a joint parallel to the new point's: ZZ + x MX + y MY is an
/// element of the mass matrix, and written so that it is shared
DraftBody slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x, const DraftValue& y,
                   bool hinge, const DraftBody& b);
DraftWrench slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x,
                     const DraftValue& y, const DraftWrench& w);
DraftScrew slide_xy(Draft& draft, const DraftOwner& owner, const DraftValue& x, const DraftValue& y,
                    const DraftScrew& s);

/// Force and moment that unit acceleration of a joint along or about z asks of a body.
DraftWrench unit_wrench(const DraftBody& body, bool revolute);

/// The wrench's work in the screw's motion.
DraftValue work(const DraftScrew& screw, const DraftWrench& wrench);

}  // namespace dyngen
