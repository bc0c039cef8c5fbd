// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/diagnosis/names/findings.h"
#include "runtime/report/document.h"
#include "runtime/report/residual_views.h"
#include "runtime/tools/dynid/diagnose/forward_comparison.h"
#include "runtime/tools/dynid/diagnose/text_plot.h"
#include "runtime/tools/dynid/ripple/joint_ripple.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/tools/dynid/robot/identified_description.h"
#include "runtime/tools/dynid/steady/steady_report.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {

/// What the file of an effect says about it, for people.
struct EffectWords {
  std::string title, formula;
  std::vector<std::string> equations;        ///< a line each
  std::vector<std::string> units, meanings;  ///< of the parameters
  std::string plot;                          ///< variable that it is drawn over; empty: none
  std::string code;                          ///< statements that dyngen writes; empty: none
  std::string why_no_code;                   ///< a reason; empty where there is code
};

/// A recording that was looked at.
struct DiagnosedRecording {
  std::string name;
  std::string use;  ///< "fitted", "held out", "reference"
  double seconds = 0;
  /// Of a recording that is too long for memory: s, first and last sample of what is used.
  std::vector<std::pair<double, double>> stretches{};
};

/// A diagnosis with all that its JSON, its page and its text say.
struct DiagnosisReport {
  std::string robot;
  std::string joint_legend;    ///< "joints: 1 shoulder, ..."; empty: joints have no names
  std::vector<bool> revolute;  ///< (n)
  Diagnosis diagnosis;
  std::vector<EffectWords> words;              ///< of each finding
  std::vector<std::string> certificate_units;  ///< of each line; "" where no parameter is named
  std::string trajectory;                      ///< file of the next experiment; empty: none
  std::string robot_path, json_path;           ///< files of this diagnosis; empty: none
  std::vector<DiagnosedRecording> recordings;
  std::vector<std::string> notes;  ///< of the robot file's numbers
  bool residual_only = false;
  double false_alarm = 0;
  std::uint64_t seed = 0;
  std::string command, version;
  DiagnosisViews views;              ///< what charts show; empty where nothing was diagnosed
  ReportArm arm;                     ///< joints with findings are marked
  std::vector<int> parameter_links;  ///< of base parameters, in their order, from 1
  std::optional<ForwardComparison> forward;  ///< where a controller is given
  std::vector<std::string> written;          ///< files
  std::optional<WrittenBack> written_back;   ///< where -o is URDF or MJCF
  TwoEncoders two_encoders;
  JointRipples ripples;
  /// Rows of the improved file: ripples that no finding has.
  std::vector<EffectInstance> ripple_effects;
  SteadyJoints steady;

  [[nodiscard]] int joints() const { return static_cast<int>(revolute.size()); }
  /// Unit of a joint's torque: "N m" or "N".
  [[nodiscard]] std::string unit(int joint) const;
};

/// A diagnosis with the words that its effects have in a catalogue.
DiagnosisReport diagnosis_report(Diagnosis diagnosis, const DescribedRobot& robot,
                                 const EffectCatalogue& catalogue);

/// Coordinates, from 0, of joints on which something was found, with a name or without.
std::vector<int> marked_joints(const Diagnosis& diagnosis);

/// "clean", "explained", "not_explained", "unexplained_structure", "insufficient_data".
std::string verdict_name(Verdict verdict);

/// The joint of an effect as the answer counts: coordinates from 1, as the columns of a recording;
/// 0 for the whole robot.
int answer_joint(const EffectInstance& effect);

/// "joint 2", "joint 5 with joint 6", "the whole robot".
std::string answer_place(const EffectInstance& effect);

/// "qd2 in rad/s": the unit of a variable of the answer, by the kind of its joint; empty: none.
std::string variable_unit(const std::string& variable, const std::vector<bool>& revolute);

/// Why a finding's parameter has no interval: "scanned", "held", "not seen", "at its bound", "not
/// known"; empty: it has one.
std::string why_no_interval(const Finding& finding, std::size_t place);

/// How a finding's parameter is known, with its interval of 95 %: "13.2 +- 0.3", "2 (held)",
/// "36 (scanned)".
std::string parameter_text(const Finding& finding, std::size_t place, double interval);

/// The command that makes a file of the next experiment, of the findings in the JSON.
std::string next_command(const DiagnosisReport& report);

/// Schema dynid.diagnosis/1, docs/reference/diagnosis.md.
std::string diagnosis_json(const DiagnosisReport& report);

/// What a person reads on a terminal: some 20 lines.
std::string diagnosis_text(const DiagnosisReport& report, const TextStyle& style = {});

}  // namespace dyngen::runtime
