// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "gen/algorithms/bodies/centroid.h"
#include "gen/algorithms/derivatives/coriolis_matrix.h"
#include "gen/algorithms/derivatives/derivatives.h"
#include "gen/algorithms/forward_dynamics/forward_dynamics.h"
#include "gen/algorithms/inverse_dynamics/friction.h"
#include "gen/algorithms/inverse_dynamics/gravity.h"
#include "gen/algorithms/inverse_dynamics/rnea_search.h"
#include "gen/algorithms/kinematics/external_torque.h"
#include "gen/algorithms/kinematics/jacobian.h"
#include "gen/algorithms/kinematics/pose.h"
#include "gen/algorithms/mass_matrix/mass_matrix.h"
#include "gen/algorithms/regressors/energy.h"
#include "gen/algorithms/regressors/gravity_regressor.h"
#include "gen/algorithms/regressors/regressor.h"
#include "gen/functions/regressor_gradient.h"

namespace dyngen {
namespace {

void write_id(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.effects = true;
  write_shortest_rnea(trace, code, terms);
}

void write_id_rigid(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.friction = false;
  write_shortest_rnea(trace, code, terms);
}

void write_coriolis(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.motion = {.velocity = true, .acceleration = false, .gravity = false};
  terms.rotor = terms.friction = terms.wrench = false;
  write_shortest_rnea(trace, code, terms);
}

void write_id_dq_pos(Trace& trace, const CodeModel& code) {
  write_derivatives(trace, code, {.position = "D"});
}

void write_id_dq(Trace& trace, const CodeModel& code) {
  write_derivatives(trace, code, {.velocity = "D"});
}

void write_id_ddq(Trace& trace, const CodeModel& code) { write_mass_matrix(trace, code, "D"); }

void write_id_derivatives(Trace& trace, const CodeModel& code) {
  write_derivatives(trace, code, {.position = "D_q", .velocity = "D_dq", .acceleration = "D_ddq"});
}

OutputSpec joint_square(std::string_view array, std::string_view unit) {
  return {.array = array, .columns = Extent::kJoints, .unit = unit};
}

constexpr ExtraInputs kAllInputs = {.gravity = true, .wrench = true, .payload = true};

OutputSpec joint_torque() { return {.array = "tau"}; }

}  // namespace

int extent_size(Extent extent, const CodeModel& code) {
  switch (extent) {
    case Extent::kOne:
      return 1;
    case Extent::kThree:
      return 3;
    case Extent::kFour:
      return 4;
    case Extent::kSix:
      return 6;
    case Extent::kJoints:
      return static_cast<int>(code.coordinate_names.size());
    case Extent::kChi:
      return static_cast<int>(code.chi.size());
    case Extent::kBeta:
      return static_cast<int>(code.beta.size());
    case Extent::kFolded:
      return static_cast<int>(code.folded.size());
  }
  return 0;
}

const std::vector<FunctionSpec>& function_catalogue() {
  static const std::vector<FunctionSpec> kCatalogue = {
      {.name = "id",
       .inputs = {"q", "dq", "ddq"},
       .outputs = {joint_torque()},
       .reads = kAllInputs,
       .summary = "tau = M(q) ddq + c(q, dq) + g(q) + friction: inverse dynamics by customised "
                  "Newton-Euler [KD02, ch. 9].",
       .write = write_id,
       .effects = EffectPart::kIn},
      {"id_rigid",
       {"q", "dq", "ddq"},
       {joint_torque()},
       kAllInputs,
       "tau = M(q) ddq + c(q, dq) + g(q): inverse dynamics without friction and offset.",
       write_id_rigid},
      {"gravity",
       {"q"},
       {joint_torque()},
       {.gravity = true, .payload = true},
       "tau = g(q): the torque that holds the arm still.",
       write_gravity_torque},
      {"coriolis",
       {"q", "dq"},
       {joint_torque()},
       {.payload = true},
       "tau = c(q, dq): Coriolis and centrifugal torque.",
       write_coriolis},
      {.name = "friction",
       .inputs = {"dq"},
       .outputs = {joint_torque()},
       .reads = {},
       .summary = "tau = FS sign(dq) + FV dq + OFF: friction and offset torque, sign(0) = 0.",
       .write = write_friction,
       .effects = EffectPart::kIn,
       .inputs_of = friction_inputs},
      {.name = "effects",
       .inputs = {"q", "dq", "ddq"},
       .outputs = {joint_torque()},
       .reads = {},
       .summary = "tau: the torque of the effects alone.",
       .write = write_effect_torque,
       .why_absent = why_no_effects,
       .effects = EffectPart::kIn},
      {"mass_matrix",
       {"q"},
       {{.array = "M", .rows = Extent::kJoints, .columns = Extent::kJoints, .unit = "kg m^2"}},
       {.payload = true},
       "M = M(q): the inertia matrix of the joints, rotor inertia on its diagonal; by composite "
       "bodies.",
       [](Trace& trace, const CodeModel& code) { write_mass_matrix(trace, code, "M"); }},
      {"coriolis_matrix",
       {"q", "dq"},
       {joint_square("C", "torque per rad/s or m/s")},
       {.payload = true},
       "C = C(q, dq): Coriolis matrix of the Christoffel symbols: C dq = c(q, dq), and dM/dt - 2 C "
       "is skew.",
       write_coriolis_matrix},
      {"coriolis_matrix_fast",
       {"q", "dq"},
       {joint_square("C", "torque per rad/s or m/s")},
       {.payload = true},
       "Another matrix with C dq = c(q, dq), of fewer operations; dM/dt - 2 C is not skew.",
       write_coriolis_matrix_fast},
      {.name = "fd",
       .inputs = {"q", "dq", "tau"},
       .outputs = {{.array = "ddq", .unit = "rad/s^2 (m/s^2 where a joint slides)"}},
       .reads = kAllInputs,
       .summary = "ddq = M(q)^-1 (tau - c(q, dq) - g(q) - friction): forward dynamics.",
       .write = write_forward_dynamics,
       .why_absent = why_no_forward_dynamics,
       .is_missed = true,
       .effects = EffectPart::kIn},
      {"regressor",
       {"q", "dq", "ddq"},
       {{.array = "Y", .columns = Extent::kChi, .unit = "torque per unit parameter"}},
       {.gravity = true},
       "tau = Y chi: regressor of inverse dynamics; columns of lengths are 0.",
       write_regressor},
      {"base_regressor",
       {"q", "dq", "ddq"},
       {{.array = "Y", .columns = Extent::kBeta, .unit = "torque per unit parameter"}},
       {.gravity = true},
       "tau = Y beta: regressor of inverse dynamics in the base parameters.",
       write_base_regressor},
      {.name = "base_regressor_gradient",
       .inputs = {"q", "dq", "ddq"},
       .outputs = {{.array = "g_q", .unit = "per rad or m"},
                   {.array = "g_dq", .unit = "per rad/s or m/s"},
                   {.array = "g_ddq", .unit = "per rad/s^2 or m/s^2"}},
       .reads = {.gravity = true, .weights = true},
       .summary = "Gradient of the sum of A_jc Y_jc over all elements of the base regressor, by q, "
                  "dq and ddq; sign(dq) has none.",
       .write = write_regressor_gradient,
       .why_absent = why_no_regressor_gradient},
      {"gravity_regressor",
       {"q"},
       {{.array = "Y", .columns = Extent::kBeta, .unit = "torque per unit parameter"}},
       {.gravity = true},
       "g(q) = Y beta: regressor of the torque that holds the arm still.",
       write_gravity_regressor},
      {"energy_regressor",
       {"q", "dq"},
       {{.array = "H", .rows = Extent::kBeta, .unit = "J per unit parameter"}},
       {.gravity = true},
       "E = H beta: kinetic and potential energy, of the rotors too; no accelerations.",
       write_energy_regressor},
      {"power",
       {"dq"},
       {{.array = "P", .rows = Extent::kBeta, .unit = "W per unit parameter"}},
       {},
       "P beta: power that is not stored; dq . tau = d(H beta)/dt + P beta.",
       write_power},
      {"id_dq_pos",
       {"q", "dq", "ddq"},
       {joint_square("D", "torque per rad or m")},
       kAllInputs,
       "D_ij = d tau_i / d q_j: derivatives of id by the positions.",
       write_id_dq_pos},
      {"id_dq",
       {"q", "dq"},
       {joint_square("D", "torque per rad/s or m/s")},
       {.payload = true},
       "D_ij = d tau_i / d dq_j: derivatives of id by the velocities; sign(dq) has none.",
       write_id_dq},
      {"id_ddq",
       {"q"},
       {joint_square("D", "torque per rad/s^2 or m/s^2")},
       {.payload = true},
       "D_ij = d tau_i / d ddq_j: derivatives of id by the accelerations, the mass matrix.",
       write_id_ddq},
      {"id_derivatives",
       {"q", "dq", "ddq"},
       {joint_square("D_q", "torque per rad or m"), joint_square("D_dq", "torque per rad/s or m/s"),
        joint_square("D_ddq", "torque per rad/s^2 or m/s^2")},
       kAllInputs,
       "Derivatives of id by q, dq and ddq, which share much of their work: D_ij = d tau_i / d "
       "x_j.",
       write_id_derivatives},
      {.name = "fk",
       .inputs = {"q"},
       .outputs = {{"T", Extent::kFour, Extent::kFour, "m (last column)"}},
       .reads = {},
       .summary = "T: pose of the link's frame in frame 0.",
       .write_of_link = write_pose,
       .effects = EffectPart::kNone},
      {.name = "jacobian",
       .inputs = {"q"},
       .outputs = {{"J", Extent::kSix, Extent::kJoints, "m, 1 (m/s, rad/s per joint rate)"}},
       .reads = {},
       .summary = "v = J dq: velocity vx vy vz of the link's origin and angular velocity wx wy wz, "
                  "in the axes of frame 0.",
       .write_of_link = write_jacobian,
       .effects = EffectPart::kNone},
      {.name = "external_torque",
       .inputs = {"q"},
       .outputs = {joint_torque()},
       .reads = {.load = true},
       .summary = "tau = J^T w: the torque that a wrench on the link puts on the joints, J the "
                  "Jacobian of its frame.",
       .write_of_link = write_external_torque,
       .effects = EffectPart::kNone},
      {.name = "com",
       .inputs = {"q"},
       .outputs = {{.array = "p", .rows = Extent::kThree, .unit = "m"},
                   {.array = "mass", .rows = Extent::kOne, .unit = "kg"}},
       .reads = {.payload = true},
       .summary = "p: centre of mass of all links in frame 0; mass: theirs together.",
       .write = write_center_of_mass,
       .why_absent = why_no_centroid,
       .effects = EffectPart::kNone},
      {.name = "com_jacobian",
       .inputs = {"q"},
       .outputs = {{"J", Extent::kThree, Extent::kJoints, "m, 1 (m/s per joint rate)"}},
       .reads = {.payload = true},
       .summary = "v = J dq: velocity of the centre of mass of all links, in the axes of frame 0.",
       .write = write_center_of_mass_jacobian,
       .why_absent = why_no_centroid,
       .effects = EffectPart::kNone},
      {.name = "momentum",
       .inputs = {"q", "dq"},
       .outputs = {{.array = "h", .rows = Extent::kSix, .unit = "kg m/s, kg m^2/s"}},
       .reads = {.payload = true},
       .summary = "h: momentum of all links, then their angular momentum about the origin of frame "
                  "0, in its axes; without the spin of the rotors.",
       .write = write_momentum,
       .why_absent = why_no_centroid,
       .effects = EffectPart::kNone},
  };
  return kCatalogue;
}

const FunctionSpec& fold_spec() {
  static const FunctionSpec kFold = {
      .name = "fold",
      .inputs = {},
      .outputs = {{.array = "folded", .rows = Extent::kFolded}},
      .reads = {},
      .summary = "What the other functions read of chi: to be called when chi has changed.",
      .effects = EffectPart::kNone};
  return kFold;
}

std::string FunctionName::text() const {
  return link == 0 ? std::string(spec->name) : fmt::format("{}_{}", spec->name, link);
}

FunctionName parse_function_name(std::string_view name) {
  for (const FunctionSpec& spec : function_catalogue()) {
    if (spec.name == name) return {&spec, 0};
    if (!spec.of_link() || name.size() < spec.name.size() + 2 || !name.starts_with(spec.name) ||
        name[spec.name.size()] != '_') {
      continue;
    }
    const std::string_view digits = name.substr(spec.name.size() + 1);
    int link = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), link);
    // the one spelling of a number: no sign, no zero in front
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (whole && digits[0] >= '1') return {&spec, link};
  }
  return {};
}

const FunctionSpec* find_function(std::string_view name) { return parse_function_name(name).spec; }

std::string catalogue_names() {
  std::string names;
  for (const FunctionSpec& spec : function_catalogue()) {
    names += (names.empty() ? "" : ", ") + std::string(spec.name);
    if (spec.of_link()) names += fmt::format(", {}_LINK", spec.name);
  }
  return names;
}

bool has_state(const FunctionSpec& spec, const CodeModel& code) {
  return spec.effects == EffectPart::kIn && !code.memory.empty();
}

std::vector<Argument> arguments(const FunctionSpec& spec, const CodeModel& code) {
  std::vector<Argument> result;
  if (has_state(spec, code)) {
    result.push_back({.name = std::string(kStateArgument), .state = true});
  }
  const int joints = extent_size(Extent::kJoints, code);
  const auto add = [&](std::string_view name, int size, bool shared) {
    result.push_back({.name = std::string(name), .rows = size, .shared = shared});
  };
  const auto inputs = spec.inputs_of == nullptr ? spec.inputs : spec.inputs_of(code);
  for (const std::string_view name : inputs) add(name, joints, false);
  ExtraInputs reads = spec.reads;
  if (spec.effects == EffectPart::kIn && effects_read(code, {"tau_load"})) reads = kAllInputs;
  if (reads.weights) {
    result.push_back({.name = "A", .rows = joints, .columns = extent_size(Extent::kBeta, code)});
  }
  if (reads.load) add("w", 6, false);
  if (code.options.gravity && reads.gravity) add("gravity", 3, true);
  if (code.options.wrench && reads.wrench) add("wrench", 6, false);
  if (code.options.payload && reads.payload) add("payload", kInertialCount, true);
  if (code.folds() && &spec != &fold_spec()) {
    add("folded", extent_size(Extent::kFolded, code), true);
  } else if (code.takes_chi) {
    add("chi", extent_size(Extent::kChi, code), true);
  }
  for (const OutputSpec& output : spec.outputs) {
    result.push_back({.name = std::string(output.array),
                      .rows = extent_size(output.rows, code),
                      .columns = extent_size(output.columns, code),
                      .output = true});
  }
  return result;
}

}  // namespace dyngen
