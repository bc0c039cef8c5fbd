// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/function_table.h"

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

OutputSpec joint_torque() { return {.array = "tau"}; }

/// Torque and its parts.
std::vector<FunctionSpec> torque_functions() {
  return {
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
  };
}

/// Matrices of the joints, and accelerations.
std::vector<FunctionSpec> matrix_functions() {
  return {
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
  };
}

/// Regressors, and their gradient.
std::vector<FunctionSpec> regressor_functions() {
  return {
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
  };
}

/// Derivatives of the torque.
std::vector<FunctionSpec> derivative_functions() {
  return {
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
  };
}

/// Functions of one link's frame.
std::vector<FunctionSpec> link_functions() {
  return {
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
  };
}

/// Functions of all bodies together.
std::vector<FunctionSpec> robot_functions() {
  return {
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
}

}  // namespace

std::vector<FunctionSpec> function_table() {
  std::vector<FunctionSpec> all;
  for (const auto& part : {torque_functions(), matrix_functions(), regressor_functions(),
                           derivative_functions(), link_functions(), robot_functions()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace dyngen
