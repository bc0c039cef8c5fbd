// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/body_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace dyngen {

namespace {

// Numbers are rounded, and of real arms they are measured: those of the PUMA 560's forearm
// (Armstrong, Khatib and Burdick 1986) miss a bound by a tenth.
constexpr double kCentreError = 0.01, kMomentError = 0.15, kPrincipalError = 0.05;

constexpr std::array<RowKey, 3> kMoments = {RowKey::kXX, RowKey::kYY, RowKey::kZZ};
constexpr std::array<RowKey, 3> kFirstMoments = {RowKey::kMX, RowKey::kMY, RowKey::kMZ};
/// kProducts[k] is the product of the two axes other than k.
constexpr std::array<RowKey, 3> kProducts = {RowKey::kYZ, RowKey::kXZ, RowKey::kXY};

double number_of(const GiNaC::ex& value) {
  return GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double();
}

/// What the file writes for a link, or null. Rows that are wrong may be short.
const FieldValue* field_of(const RobotFile& file, RowKey key, std::size_t link) {
  const Row& row = file.row(key);
  return row.present && link < row.values.size() ? &row.values[link] : nullptr;
}

/// Joint types and parents as far as the rows say them.
int sigma_of(const RobotFile& file, std::size_t joint) {
  const FieldValue* value = field_of(file, RowKey::kSigma, joint);
  return value == nullptr || value->unknown ? 0 : static_cast<int>(number_of(value->value));
}

std::size_t parent_of(const RobotFile& file, std::size_t joint) {
  const FieldValue* value = field_of(file, RowKey::kAnt, joint);
  return value == nullptr || value->unknown ? joint
                                            : static_cast<std::size_t>(number_of(value->value));
}

/// One link's numbers; what is absent or unknown is 0.
class LinkNumbers {
 public:
  LinkNumbers(const RobotFile& file, std::size_t link) : file_(file), link_(link) {}

  [[nodiscard]] const FieldValue* field(RowKey key) const { return field_of(file_, key, link_); }
  [[nodiscard]] double at(RowKey key) const {
    const FieldValue* value = field(key);
    return value == nullptr || value->unknown ? 0 : number_of(value->value);
  }
  [[nodiscard]] bool unknown(RowKey key) const {
    const FieldValue* value = field(key);
    return value != nullptr && value->unknown;
  }
  [[nodiscard]] double mass() const { return at(RowKey::kM); }
  [[nodiscard]] double moment(std::size_t axis) const { return at(kMoments[axis]); }
  [[nodiscard]] double first(std::size_t axis) const { return at(kFirstMoments[axis]); }
  [[nodiscard]] double product(std::size_t axis) const { return at(kProducts[axis]); }
  /// Of the mass at its centre, about an axis through the origin.
  [[nodiscard]] double moment_of_centre(std::size_t axis) const {
    const double a = first((axis + 1) % 3), b = first((axis + 2) % 3);
    return (a * a + b * b) / mass();
  }
  [[nodiscard]] std::size_t number() const { return link_ + 1; }

 private:
  const RobotFile& file_;  // outlives it
  std::size_t link_;
};

void warn_at(const FieldValue& value, const std::string& message, const std::string& hint,
             Diagnostics& diagnostics) {
  diagnostics.warning(value.position, value.length, message, hint);
}

std::string shown(const FieldValue& value) { return printable(value.text); }

/// The checks of one link, from the plain ones on: what one has found the later ones leave alone.
class BodyCheck {
 public:
  BodyCheck(LinkNumbers link, Diagnostics& diagnostics) : link_(link), diagnostics_(diagnostics) {}

  void run() {
    for (std::size_t axis = 0; axis < 3; ++axis) check_sign(axis);
    if (found_) return;
    if (link_.mass() > 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) check_centre(axis);
    }
    if (found_) return;
    check_sum();
    for (std::size_t axis = 0; axis < 3; ++axis) check_product(axis);
    if (!found_) check_principal();
  }

 private:
  void warn(RowKey key, const std::string& message, const char* hint) {
    found_ = true;
    warn_at(*link_.field(key), message, hint, diagnostics_);
  }
  /// "'ZZ' of link 2 is 0.02"
  [[nodiscard]] std::string what(RowKey key) const {
    return fmt::format("'{}' of link {} is {}", row_keyword(key), link_.number(),
                       shown(*link_.field(key)));
  }

  void check_sign(std::size_t axis) {
    if (link_.moment(axis) >= 0) return;
    warn(kMoments[axis], what(kMoments[axis]) + ": no body has a negative moment of inertia",
         "expected more than 0; sums of several bodies are base parameters");
  }

  void check_centre(std::size_t axis) {
    const double moment = link_.moment(axis), least = link_.moment_of_centre(axis);
    if (moment == 0 || moment >= least * (1 - kCentreError)) return;
    warn(kMoments[axis],
         fmt::format("{}, below the moment of its mass at its centre, ({}^2 + {}^2)/m = {:.4g}",
                     what(kMoments[axis]), row_keyword(kFirstMoments[axis == 0 ? 1 : 0]),
                     row_keyword(kFirstMoments[axis == 2 ? 1 : 2]), least),
         "given at the centre of mass? expected about the frame's origin: add m c^2");
  }

  [[nodiscard]] bool has_all_moments() const {
    return link_.moment(0) > 0 && link_.moment(1) > 0 && link_.moment(2) > 0;
  }

  void check_sum() {
    if (!has_all_moments()) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
      const double sum = link_.moment(a) + link_.moment(b);
      if (link_.moment(axis) <= sum * (1 + kMomentError)) continue;
      warn(kMoments[axis],
           fmt::format("{}, more than {} + {} = {:.4g}: no body has it", what(kMoments[axis]),
                       row_keyword(kMoments[a]), row_keyword(kMoments[b]), sum),
           "each moment of inertia is at most the sum of the two others");
    }
  }

  /// |integral of x y| <= integral of (x^2 + y^2)/2
  void check_product(std::size_t axis) {
    const double moment = link_.moment(axis);
    if (moment == 0 || std::fabs(link_.product(axis)) <= moment / 2 * (1 + kMomentError)) return;
    warn(kProducts[axis],
         fmt::format("{}, larger than {}/2 = {:.4g}: no body has it", what(kProducts[axis]),
                     row_keyword(kMoments[axis]), moment / 2),
         "a product of inertia is at most half the moment about the third axis");
  }

  /// All ten numbers together: the moments about the centre of mass.
  void check_principal() {
    if (link_.mass() <= 0 || !has_all_moments()) return;
    for (const RowKey key :
         {RowKey::kMX, RowKey::kMY, RowKey::kMZ, RowKey::kXY, RowKey::kXZ, RowKey::kYZ}) {
      if (link_.field(key) == nullptr || link_.unknown(key)) return;
    }
    const std::array<double, 3> p = principal_moments();
    const double size = link_.moment(0) + link_.moment(1) + link_.moment(2);
    const bool exists = p[0] >= -kPrincipalError * size &&
                        p[2] <= (p[0] + p[1]) * (1 + kMomentError) + kPrincipalError * size;
    if (exists) return;
    warn(RowKey::kXX,
         fmt::format("the inertia of link {} about its centre of mass has the principal moments "
                     "{:.3g}, {:.3g}, {:.3g}: no body has them",
                     link_.number(), p[0], p[1], p[2]),
         "each is at most the sum of the two others; XY = -integral of x y dm: check the signs");
  }

  /// About the centre of mass, in rising order; by Jacobi's rotations.
  [[nodiscard]] std::array<double, 3> principal_moments() const {
    std::array<std::array<double, 3>, 3> J{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      J[i][i] = link_.moment(i) - link_.moment_of_centre(i);
      J[i][k] = J[k][i] = link_.product(3 - i - k) + link_.first(i) * link_.first(k) / link_.mass();
    }
    constexpr int kSweeps = 20;  // each squares what is left
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t i = 0; i < 3; ++i) rotate(J, i, (i + 1) % 3);
    }
    std::array<double, 3> p = {J[0][0], J[1][1], J[2][2]};
    std::sort(p.begin(), p.end());
    return p;
  }

  static void rotate(std::array<std::array<double, 3>, 3>& J, std::size_t i, std::size_t k) {
    if (J[i][k] == 0) return;
    // the smaller of the two angles: with the larger one sweeps may go round for ever
    const double apart = J[i][i] - J[k][k];
    const double angle = apart == 0 ? std::atan(1) : std::atan(2 * J[i][k] / apart) / 2;
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t n = 0; n < 3; ++n) {
      const double a = J[i][n], b = J[k][n];
      J[i][n] = c * a + s * b;
      J[k][n] = c * b - s * a;
    }
    for (auto& row : J) {
      const double a = row[i], b = row[k];
      row[i] = c * a + s * b;
      row[k] = c * b - s * a;
    }
  }

  LinkNumbers link_;
  Diagnostics& diagnostics_;
  bool found_ = false;
};

/// Where other links have masses, one without has no first moments.
void check_first_moments(const RobotFile& file, Diagnostics& diagnostics) {
  const auto& masses = file.row(RowKey::kM).values;
  const bool any = std::any_of(masses.begin(), masses.end(), [](const FieldValue& mass) {
    return mass.unknown || number_of(mass.value) > 0;
  });
  if (!any) return;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (masses[i].unknown || number_of(masses[i].value) != 0) continue;
    const LinkNumbers link(file, i);
    for (const RowKey key : kFirstMoments) {
      if (link.at(key) == 0) continue;
      warn_at(masses[i],
              fmt::format("the mass of link {} is 0, but its '{}' is {}: no body has it", i + 1,
                          row_keyword(key), shown(*link.field(key))),
              "a first moment is mass times centre of mass: expected a mass", diagnostics);
      break;
    }
  }
}

/// @param of_slides  only values of prismatic joints are lengths
void check_lengths(const RobotFile& file, RowKey key, bool of_slides, Diagnostics& diagnostics) {
  constexpr double kLongest = 20;  // m
  const std::vector<FieldValue>& values = file.row(key).values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const FieldValue& value = values[i];
    if (value.unknown || (of_slides && sigma_of(file, i) != 1)) continue;
    const double length = number_of(value.value);
    if (std::fabs(length) <= kLongest) continue;
    warn_at(value,
            fmt::format("'{}' of joint {} is {}: a length of {:g} m", row_keyword(key), i + 1,
                        shown(value), std::fabs(length)),
            fmt::format("lengths are in metres; millimetres? write {:g}", length / 1000),
            diagnostics);
  }
}

/// Masses far out, where their numbers are in kg mm or kg mm^2.
void check_radii(const LinkNumbers& link, Diagnostics& diagnostics) {
  constexpr double kFarthest = 20;  // m
  const double mass = link.mass();
  if (mass <= 0) return;
  for (const RowKey key : kFirstMoments) {
    const double centre = std::fabs(link.at(key)) / mass;
    if (centre <= kFarthest) continue;
    warn_at(*link.field(key),
            fmt::format("'{}' of link {} is {}: its mass of {:g} kg would have its centre at "
                        "{:.4g} m",
                        row_keyword(key), link.number(), shown(*link.field(key)), mass, centre),
            "expected kg m; kg mm? divide by 1000", diagnostics);
  }
  for (const RowKey key : kMoments) {
    const double radius = std::sqrt(std::max(0.0, link.at(key)) / mass);
    if (radius <= kFarthest) continue;
    warn_at(
        *link.field(key),
        fmt::format("'{}' of link {} is {}: its mass of {:g} kg would have a radius of gyration "
                    "of {:.4g} m",
                    row_keyword(key), link.number(), shown(*link.field(key)), mass, radius),
        "expected kg m^2; kg mm^2? divide by 1000000", diagnostics);
  }
}

/// Whether quantities are zero, and whether a row that is absent makes them so.
struct Zeros {
  bool all = true;
  bool absent = false;

  void add(const FieldValue* value) {
    if (value == nullptr) {
      absent = true;
    } else if (value->unknown || !value->value.is_zero()) {
      all = false;
    }
  }
  /// Whether this is to be said.
  [[nodiscard]] bool said(AbsentRows rows) const {
    return all && absent == (rows == AbsentRows::kZero);
  }
};

/// What each joint carries: its own link and those that hang on it, and its rotor.
std::vector<Zeros> what_is_carried(const RobotFile& file) {
  const auto joints = static_cast<std::size_t>(file.joint_count);
  std::vector<Zeros> result(joints);
  for (std::size_t j = joints; j-- > 0;) {
    for (const RowKey key : {RowKey::kM, RowKey::kMX, RowKey::kMY, RowKey::kMZ, RowKey::kXX,
                             RowKey::kXY, RowKey::kXZ, RowKey::kYY, RowKey::kYZ, RowKey::kZZ}) {
      result[j].add(field_of(file, key, j));
    }
    const std::size_t parent = parent_of(file, j);
    if (parent > 0 && parent <= j) {
      result[parent - 1].all = result[parent - 1].all && result[j].all;
      result[parent - 1].absent = result[parent - 1].absent || result[j].absent;
    }
  }
  for (std::size_t j = 0; j < joints; ++j) result[j].add(field_of(file, RowKey::kIA, j));
  return result;
}

void check_carried(const RobotFile& file, AbsentRows rows, Diagnostics& diagnostics) {
  std::string joints;
  int count = 0;
  const std::vector<Zeros> zeros = what_is_carried(file);
  for (std::size_t j = 0; j < zeros.size(); ++j) {
    if (sigma_of(file, j) == 2 || !zeros[j].said(rows)) continue;
    joints += fmt::format("{}{}", count++ > 0 ? ", " : "", j + 1);
  }
  if (count == 0) return;
  const Row& masses = file.row(RowKey::kM);
  diagnostics.warning(
      masses.present ? masses.keyword : file.last_word, 1,
      fmt::format("joint{} {} carr{} neither mass nor inertia: no such torque is in the model",
                  count > 1 ? "s" : "", joints, count > 1 ? "y" : "ies"),
      "give rows m, mX .. ZZ and IA; write * for what is not known");
}

/// A mass beside the joint's own axis, about which its link has no moment of inertia.
void check_own_axis(const RobotFile& file, std::size_t j, AbsentRows rows,
                    Diagnostics& diagnostics) {
  const LinkNumbers link(file, j);
  if (sigma_of(file, j) != 0 || link.mass() <= 0) return;
  // the axis in the link's frame: z, or (0, sin al, cos al) of the standard convention
  double y = 0, z = 1;
  if (file.convention == DhConvention::kStandard) {
    y = std::sin(link.at(RowKey::kAl));
    z = std::cos(link.at(RowKey::kAl));
  }
  constexpr double kAlong = 1e-9;  // a right angle in floating point
  Zeros zeros;
  zeros.add(link.field(RowKey::kIA));
  zeros.absent = false;  // rotors may well be left out
  if (std::fabs(z) > kAlong) zeros.add(link.field(RowKey::kZZ));
  if (std::fabs(y) > kAlong) zeros.add(link.field(RowKey::kYY));
  if (!zeros.said(rows)) return;
  const double x = link.first(0), beside = link.first(1) * z - link.first(2) * y;
  const double distance = std::hypot(x, beside) / link.mass();
  if (distance == 0) return;
  const RowKey moment = std::fabs(z) > kAlong ? RowKey::kZZ : RowKey::kYY;
  warn_at(*link.field(RowKey::kM),
          fmt::format("link {} has {} kg at {:.4g} m from the axis of its joint, but '{}' is 0: no "
                      "body has it",
                      link.number(), shown(*link.field(RowKey::kM)), distance, row_keyword(moment)),
          fmt::format("expected {:.4g} kg m^2 or more", link.mass() * distance * distance),
          diagnostics);
}

}  // namespace

void check_bodies(const RobotFile& file, Diagnostics& diagnostics) {
  if (file.parameters == ParameterMeaning::kBase) return;  // no single bodies
  for (int i = 0; i < file.joint_count; ++i) {
    BodyCheck(LinkNumbers(file, static_cast<std::size_t>(i)), diagnostics).run();
  }
  check_first_moments(file, diagnostics);
}

void check_sizes(const RobotFile& file, Diagnostics& diagnostics) {
  check_lengths(file, RowKey::kD, false, diagnostics);
  check_lengths(file, RowKey::kR, false, diagnostics);
  check_lengths(file, RowKey::kQmin, true, diagnostics);
  check_lengths(file, RowKey::kQmax, true, diagnostics);
  for (int i = 0; i < file.joint_count; ++i) {
    if (file.parameters == ParameterMeaning::kBase) break;  // no single bodies
    check_radii(LinkNumbers(file, static_cast<std::size_t>(i)), diagnostics);
  }
  constexpr double kStrongest = 30;  // m/s^2: Jupiter has 25
  for (const RowKey key : {RowKey::kGx, RowKey::kGy, RowKey::kGz}) {
    for (const FieldValue& value : file.row(key).values) {
      if (value.unknown || std::fabs(number_of(value.value)) <= kStrongest) continue;
      warn_at(value, fmt::format("'{}' is {} m/s^2", row_keyword(key), shown(value)),
              "expected metres per second squared: 9.81 on earth", diagnostics);
    }
  }
}

void check_masses(const RobotFile& file, AbsentRows absent, Diagnostics& diagnostics) {
  if (file.parameters == ParameterMeaning::kBase) return;  // no single bodies
  check_carried(file, absent, diagnostics);
  for (int i = 0; i < file.joint_count; ++i) {
    check_own_axis(file, static_cast<std::size_t>(i), absent, diagnostics);
  }
}

}  // namespace dyngen
