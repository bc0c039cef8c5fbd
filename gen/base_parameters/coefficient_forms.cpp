// SPDX-License-Identifier: GPL-2.0-or-later
#include <cln/float.h>
#include <cln/integer.h>
#include <cln/rational.h>

#include <array>
#include <map>
#include <utility>

#include "gen/base_parameters/base_forms.h"
#include "gen/base_parameters/numeric_regressor.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using cln::cl_R;
using cln::cl_RA;
using Geometry = NumericGeometry<cl_R>;
using Row = std::vector<cl_R>;
using ExactVector = std::array<cl_R, 3>;

constexpr std::size_t kTwistSize = 6;  // angular, then linear velocity of the origin

ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A link's frame in its parent's at one position of the joint.
struct ExactPose {
  std::array<ExactVector, 3> R;  // R[i][k]: component i of the child's axis k
  ExactVector p;

  [[nodiscard]] ExactVector to_child(const ExactVector& v) const {
    ExactVector result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = R[0][k] * v[0] + R[1][k] * v[1] + R[2][k] * v[2];
    }
    return result;
  }
  [[nodiscard]] ExactVector to_parent(const ExactVector& v) const {
    ExactVector result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2];
    }
    return result;
  }
};

/// Positions of a joint that tell its basis functions apart; the first one is q = 0.
///
/// 1, c, s, c^2, c s take five points of the circle, 1, q, q^2 three of the line. With the
/// functions chosen to vanish at q = 0 (c - 1, s, ...) the coefficient of 1 is the value there.
std::vector<ExactPose> poses(const Geometry::Link& link) {
  const auto at = [&](const cl_R& c, const cl_R& s, const cl_R& along) {
    const cl_R cos = link.cos_theta * c - link.sin_theta * s;
    const cl_R sin = link.sin_theta * c + link.cos_theta * s;
    const cl_R &ca = link.cos_alpha, &sa = link.sin_alpha;
    const cl_R r = link.r + along;
    ExactPose pose;
    pose.R = {{{cos, -sin, 0}, {ca * sin, ca * cos, -sa}, {sa * sin, sa * cos, ca}}};
    pose.p = {link.d, -r * sa, r * ca};
    return pose;
  };
  std::vector<ExactPose> result = {at(1, 0, 0)};
  if (link.type == JointType::kRevolute) {
    result.push_back(at(cl_RA("3/5"), cl_RA("4/5"), 0));
    result.push_back(at(cl_RA("-5/13"), cl_RA("12/13"), 0));
    result.push_back(at(cl_RA("-15/17"), cl_RA("-8/17"), 0));
    result.push_back(at(cl_RA("7/25"), cl_RA("-24/25"), 0));
  } else if (link.type == JointType::kPrismatic) {
    result.push_back(at(1, 0, 1));
    result.push_back(at(1, 0, -2));
  }
  return result;
}

/// A twist of the parent as the child's frame has it.
Row twist_in_child(const ExactPose& pose, const Row& twist) {
  const ExactVector w = {twist[0], twist[1], twist[2]};
  const ExactVector carried = cross(w, pose.p);
  const ExactVector angular = pose.to_child(w);
  const ExactVector linear =
      pose.to_child({twist[3] + carried[0], twist[4] + carried[1], twist[5] + carried[2]});
  return {angular[0], angular[1], angular[2], linear[0], linear[1], linear[2]};
}

/// Inertial parameters of a body in the child's frame, as the parent's frame has them: a matrix
/// whose row k makes the k-th parameter.
NumberMatrix inertia_to_parent(const ExactPose& pose) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kPlaces = {
      {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
  NumberMatrix matrix(kInertialCount, Row(kInertialCount, cl_R(0)));
  for (std::size_t unit = 0; unit < kInertialCount; ++unit) {
    std::array<ExactVector, 3> J;
    for (ExactVector& row : J) row = {0, 0, 0};
    ExactVector s = {0, 0, 0};
    cl_R mass = 0;
    if (unit < kPlaces.size()) {
      const auto [a, b] = kPlaces[unit];
      J[a][b] = J[b][a] = 1;
    } else if (unit < index(Chi::kM)) {
      s[unit - index(Chi::kMX)] = 1;
    } else {
      mass = 1;
    }
    s = pose.to_parent(s);
    const ExactVector& p = pose.p;
    const cl_R trace = 2 * (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) +
                       mass * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    // J' = R J R^T + 2 (s.p) 1 - s p^T - p s^T + M (p.p 1 - p p^T)
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
      const std::size_t a = kPlaces[k][0], b = kPlaces[k][1];
      cl_R sum = -s[a] * p[b] - p[a] * s[b] - mass * p[a] * p[b];
      if (a == b) sum = sum + trace;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) sum = sum + pose.R[a][i] * J[i][j] * pose.R[b][j];
      }
      matrix[k][unit] = sum;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      matrix[index(Chi::kMX) + k][unit] = s[k] + mass * p[k];
    }
    matrix[index(Chi::kM)][unit] = mass;
  }
  return matrix;
}

/// row * matrix
Row times(const Row& row, const NumberMatrix& matrix) {
  Row result(matrix.front().size(), cl_R(0));
  for (std::size_t k = 0; k < matrix.size(); ++k) {
    if (cln::zerop(row[k])) continue;
    for (std::size_t c = 0; c < result.size(); ++c) {
      if (!cln::zerop(matrix[k][c])) result[c] = result[c] + row[k] * matrix[k][c];
    }
  }
  return result;
}

/// The force of a joint for a motion of its link's body, linear in the body's ten parameters:
/// e . (J w + MS x v) or e . (M v + w x MS), with e = z.
Row joint_force(JointType type, const Row& twist) {
  Row form(kInertialCount, cl_R(0));
  if (type == JointType::kRevolute) {
    form[index(Chi::kXZ)] = twist[0];
    form[index(Chi::kYZ)] = twist[1];
    form[index(Chi::kZZ)] = twist[2];
    form[index(Chi::kMX)] = twist[4];
    form[index(Chi::kMY)] = -twist[3];
  } else {
    form[index(Chi::kM)] = twist[5];
    form[index(Chi::kMY)] = twist[0];
    form[index(Chi::kMX)] = -twist[1];
  }
  return form;
}

/// What is known of a link when those below it are done.
struct LinkSpans {
  NumberMatrix twists;   // of unit rates of the joints up to its own; coefficients of all products
  NumberMatrix gravity;  // -g as a twist, likewise
  NumberMatrix forms;    // of ten parameters: all that is ever asked of the body that it carries
};

class CoefficientRoute {
 public:
  CoefficientRoute(const Geometry& geometry, const std::vector<Column>& columns, Motions motions)
      : geometry_(geometry), motions_(motions), columns_(columns.size()) {
    for (std::size_t k = 0; k < columns.size(); ++k) places_.emplace(columns[k], k);
  }

  Echelon run() {
    add_bodies();
    spans_.resize(geometry_.links.size() + 1);
    spans_[0].gravity = {
        {0, 0, 0, geometry_.gravity[0], geometry_.gravity[1], geometry_.gravity[2]}};
    for (int j = 1; j <= static_cast<int>(geometry_.links.size()); ++j) visit(j);
    return echelon(std::move(rows_), columns_);
  }

 private:
  /// bodies_[j]: the ten parameters of what link j carries at q = 0, in its frame, each a row over
  /// the columns.
  void add_bodies() {
    bodies_.assign(geometry_.links.size() + 1,
                   NumberMatrix(kInertialCount, Row(columns_, cl_R(0))));
    for (int j = static_cast<int>(geometry_.links.size()); j >= 1; --j) {
      NumberMatrix& body = bodies_[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < kInertialCount; ++k) {
        const auto it = places_.find({j, static_cast<Chi>(k)});
        if (it != places_.end()) body[k][it->second] = body[k][it->second] + 1;
      }
      const auto& link = geometry_.links[static_cast<std::size_t>(j - 1)];
      NumberMatrix& parent = bodies_[static_cast<std::size_t>(link.parent)];
      const NumberMatrix moved = inertia_to_parent(poses(link).front());
      for (std::size_t k = 0; k < kInertialCount; ++k) {
        const Row part = times(moved[k], body);
        for (std::size_t c = 0; c < columns_; ++c) parent[k][c] = parent[k][c] + part[c];
      }
    }
  }

  void visit(int j) {
    const auto& link = geometry_.links[static_cast<std::size_t>(j - 1)];
    const LinkSpans& parent = spans_[static_cast<std::size_t>(link.parent)];
    LinkSpans& own = spans_[static_cast<std::size_t>(j)];
    const std::vector<ExactPose> positions = poses(link);
    for (const ExactPose& pose : positions) {
      for (const Row& twist : parent.twists) own.twists.push_back(twist_in_child(pose, twist));
      for (const Row& twist : parent.gravity) own.gravity.push_back(twist_in_child(pose, twist));
    }
    own.gravity = echelon(std::move(own.gravity), kTwistSize).rows;

    NumberMatrix asked;  // of the body at q = 0: coefficients that no other product shares
    if (link.type != JointType::kFixed) {
      for (const Row& twist : own.gravity) asked.push_back(joint_force(link.type, twist));
      if (motions_ == Motions::kAll) {
        for (const Row& twist : own.twists) asked.push_back(joint_force(link.type, twist));
      }
    }
    own.forms = asked;
    for (const Row& form : parent.forms) {
      Row at_zero;
      for (const ExactPose& pose : positions) {
        Row moved = times(form, inertia_to_parent(pose));
        own.forms.push_back(moved);
        if (at_zero.empty()) {
          at_zero = std::move(moved);
          continue;
        }
        for (std::size_t k = 0; k < kInertialCount; ++k) moved[k] = moved[k] - at_zero[k];
        asked.push_back(std::move(moved));
      }
    }
    for (const Row& form : echelon(std::move(asked), kInertialCount).rows) add_row(j, form);

    if (link.type != JointType::kFixed && motions_ == Motions::kAll) {
      // the diagonal of M: the joint's own acceleration, where the rotor counts too
      Row rate(kTwistSize, cl_R(0));
      rate[link.type == JointType::kRevolute ? 2 : 5] = 1;
      const Row form = joint_force(link.type, rate);
      add_row(j, form);
      const auto it = places_.find({j, Chi::kIA});
      if (it != places_.end()) rows_.back()[it->second] = 1;
      own.forms.push_back(form);
      own.twists.push_back(std::move(rate));
    }
    own.twists = echelon(std::move(own.twists), kTwistSize).rows;
    own.forms = echelon(std::move(own.forms), kInertialCount).rows;
  }

  void add_row(int j, const Row& form) {
    rows_.push_back(times(form, bodies_[static_cast<std::size_t>(j)]));
  }

  const Geometry& geometry_;
  Motions motions_;
  std::size_t columns_;
  std::map<Column, std::size_t> places_;
  std::vector<NumberMatrix> bodies_;
  std::vector<LinkSpans> spans_;
  NumberMatrix rows_;
};

}  // namespace

BaseForms coefficient_forms(const SymbolicRobot& robot, const GiNaC::exmap& lengths,
                            const std::vector<Column>& columns, Motions motions) {
  const PrecisionScope precision;
  const auto geometry = numeric_geometry<cl_R>(robot, lengths);
  return {columns, CoefficientRoute(geometry, columns, motions).run()};
}

}  // namespace dyngen
