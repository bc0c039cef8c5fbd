// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_bodies.h"
#include "gen/algorithms/code_model/code_effects.h"
#include "gen/algorithms/code_model/link_form.h"
#include "gen/base_parameters/base_parameters.h"
#include "gen/symbols/symbol_table.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// What the emitted code takes as input of its dynamic parameters.
enum class ParameterMode {
  kBaked,   ///< numbers of the file stand in the code; only unknown ones are read from chi
  kRuntime  ///< all are read from chi
};

/// What the emitted functions take as arguments besides the motion.
struct CodeOptions {
  ParameterMode parameters = ParameterMode::kBaked;
  bool gravity = false;  ///< gravity[3]: the base's acceleration -g in frame 0, m/s^2
  bool wrench = false;   ///< wrench[6]: on a link
  int wrench_link = 0;   ///< the link; 0: the last one
  bool payload = false;  ///< payload[10]: a body on the last link
  bool weights = false;  ///< A[n x nbeta]: weights of the base regressor's elements
  bool fold = false;     ///< folded[] in place of chi[], and a function that computes it of chi
};

/// One entry of chi.
struct ChiEntry {
  std::string name;  ///< "ZZR2", "d3"
  std::string unit;
  std::string comment;             ///< where it comes from, or what is grouped in it
  std::optional<GiNaC::ex> value;  ///< the file's number; none if unknown
};

/// A link as the algorithms see it: inputs, constants and chi entries in place of the file's
/// symbols.
struct CodeLink {
  JointType type = JointType::kRevolute;
  int parent = 0;
  GiNaC::ex alpha = 0;  ///< exact
  GiNaC::ex theta = 0;  ///< exact
  GiNaC::ex d = 0;
  GiNaC::ex r = 0;
  /// From this frame to the file's frame of the link: Rx(tip_alpha) Tx(tip_d). 0 unless the file is
  /// in standard frames.
  GiNaC::ex tip_alpha = 0;  ///< exact
  GiNaC::ex tip_d = 0;
  std::array<GiNaC::ex, kChiCount> chi;  ///< 0, a symbol, or a sum (see with_named_parameters())
  GiNaC::ex q = 0, dq = 0, ddq = 0;      ///< inputs; 0 for a fixed joint
  GiNaC::ex tau = 0;                     ///< input of the forward dynamics
  /// Where effects read it: rotor inertia, of chi or the robot file's number; and how much of it is
  /// grouped into others, so that the torque of the rigid links has it in.
  GiNaC::ex rotor = 0, grouped_rotor = 0;
  int coordinate = -1;
};

/// The robot as the algorithms see it.
struct CodeModel {
  std::string name;
  std::string file_name;
  SymbolTable inputs;           ///< q, dq, ddq, chi, and the named numbers of the file
  std::vector<CodeLink> links;  ///< links[j - 1] is link j
  std::array<GiNaC::ex, 3> gravity;
  /// Force and moment about the origin of wrench_link() that its environment applies, in its frame.
  /// The argument speaks of the file's frame, this of the link's frame here.
  std::array<GiNaC::ex, 6> wrench;
  /// Input w: force and moment about the origin of some link's frame of the file, in the axes of
  /// frame 0; of the functions that give their torque.
  std::array<GiNaC::ex, 6> load;
  CodeBodies bodies;               ///< see add_bodies()
  std::vector<GiNaC::ex> weights;  ///< with the option weights: A, row-major
  /// Dynamic parameters, then unknown lengths and gravity components, then parameters of effects.
  std::vector<ChiEntry> chi;
  std::vector<Column> chi_columns;  ///< what the dynamic parameters in chi are: its first entries
  std::vector<std::string> beta;    ///< names of the base parameters
  std::vector<Column> beta_columns;
  std::vector<std::string> coordinate_names;
  std::vector<bool> coordinate_revolute;
  bool takes_chi = false;  ///< the functions have an argument chi: some entry of it is read
  std::vector<CodeEffect> effects;  ///< that run in a controller, in the order of the file
  EffectMemory memory;              ///< of the effects with states
  CodeOptions options;
  std::vector<std::string>
      folded;  ///< with the option fold, when functions are written: its entries
  /// The form in which the functions of the recursion are written: empty until the first of them
  /// looks for it; copies share it.
  std::shared_ptr<RneaForm> rnea_form = std::make_shared<RneaForm>();

  /// The functions read folded in place of chi.
  [[nodiscard]] bool folds() const { return options.fold && takes_chi; }

  [[nodiscard]] int size() const { return static_cast<int>(links.size()); }
  /// The link that the wrench acts on.
  [[nodiscard]] int wrench_link() const {
    return options.wrench_link > 0 ? options.wrench_link : size();
  }
  [[nodiscard]] const CodeLink& link(int j) const { return links[static_cast<std::size_t>(j - 1)]; }
};

/// @param grouping  the parameters to use: regroup(robot) or keep_standard(robot)
/// @param base      the base parameters: of regroup(robot)
/// @param effects   of the robot; those that cannot run in a controller are left out
/// @throws ModelError  if an effect reads what is unknown and grouped: see add_effects()
CodeModel make_code_model(const Regrouping& grouping, const std::vector<GroupedParameter>& base,
                          const CodeOptions& options, const std::vector<BoundEffect>& effects = {});

/// Adds an entry to chi. @return its symbol
GiNaC::ex add_chi_entry(CodeModel& code, ChiEntry entry);

/// The links with one name for each parameter that is a sum (with a payload, or of lengths).
/// @param trace  gets the statements
std::vector<CodeLink> with_named_parameters(Trace& trace, const CodeModel& code);

}  // namespace dyngen
