// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/estimation/significance.h"
#include "runtime/estimation/trust.h"
#include "runtime/estimation/unseen.h"
#include "runtime/identification/fit.h"
#include "runtime/identification/hierarchy.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/ripple/joint_ripple.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/tools/dynid/robot/identified_description.h"
#include "runtime/tools/dynid/steady/steady_report.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {

/// Condition numbers as in the thesis's Table 7.2, and what each analysis does to them.
struct Conditioning {
  double raw = 0;          ///< the regressor as it is
  double unit_norm = 0;    ///< columns of unit norm
  double sensitivity = 0;  ///< columns over experimental torque sensitivity
  Significance insensitive, dependent, weakest, essential;
};

/// Full parameters that bodies can have.
struct ConsistentFit {
  StandardParameters standard;
  Eigen::VectorXd beta;
  Eigen::VectorXd pull;  ///< (nb) standard deviations
  double cost_free = 0, cost = 0;
  bool converged = false;
  std::string message;
  Eigen::VectorXd percent, heldout_percent;
};

/// All that a fit found: what the table, the JSON and the robot file are made of.
struct FitReport {
  DescribedRobot robot;
  std::vector<RecordingLine> recordings;
  FitData data;
  RowSource heldout_rows;       ///< equations of held-out recordings; empty: none in memory
  std::vector<MethodFit> fits;  ///< the first one goes to the robot file
  Trust trust;
  Conditioning conditioning;
  std::vector<UnseenCombination> unseen;
  std::vector<SeenCombination> together;  ///< sums that are seen where their terms are not
  std::optional<ConsistentFit> consistent;
  std::optional<EffectReport> effects;      ///< of a robot file with rows 'effect'
  std::optional<HierarchyFit> hierarchy;    ///< robots that share inertia
  std::optional<WrittenBack> written_back;  ///< where -o is URDF or MJCF
  TwoEncoders two_encoders;
  SteadyJoints steady;
  std::vector<std::string> notes;
  JointRipples ripples;

  [[nodiscard]] const MethodFit& main() const { return fits.front(); }
};

/// How well a parameter is known.
enum class Seen {
  kYes,
  kWeak,  ///< its interval contains zero, or noise of accelerations biases it by more than that
  kNo     ///< part of a combination that the data do not see
};
Seen seen(const FitReport& report, int parameter);
std::string_view seen_name(Seen seen);

/// The report as a person reads it.
std::string fit_table(const FitReport& report);

/// The page. @param command  as it was called
ReportDocument fit_document(const FitReport& report, const std::string& command);

/// The report for programs: schema dynid.fit/1, docs/howto/identification.md.
std::string fit_json(const FitReport& report);

/// What is known of the identified numbers, lines of a comment.
/// @param of_description  for a URDF or MJCF, not a robot file
std::vector<std::string> identified_comment(const FitReport& report, bool of_description);

/// The identified robot file.
std::string identified_file(const FitReport& report);

/// The same of one robot of the hierarchy. @param robot  its place there
std::string identified_file(const FitReport& report, std::size_t robot);

}  // namespace dyngen::runtime
