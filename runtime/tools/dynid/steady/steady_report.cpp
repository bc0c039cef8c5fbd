// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/steady/steady_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "runtime/signals/joint_state.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A joint needs so many runs that they are a programme, not what a motion happens to have.
constexpr int kFewestRuns = 6;

/// Parameters without the friction of one joint.
VectorXd without_friction(const LinearModel& model, VectorXd beta, Index joint) {
  for (const int place : model.columns[static_cast<std::size_t>(joint)]) {
    const ParameterKind kind = model.parameters[static_cast<std::size_t>(place)].kind;
    const bool friction = kind == ParameterKind::kCoulomb || kind == ParameterKind::kViscous ||
                          kind == ParameterKind::kOffset;
    if (friction) beta[place] = 0;
  }
  return beta;
}

/// Joint states of a recording whose stretches are asked for.
class RestTorque {
 public:
  RestTorque(const LinearModel& model,
             const std::vector<std::shared_ptr<const Recording>>& recordings)
      : model_(model), recordings_(recordings), states_(recordings.size()) {}

  VectorXd operator()(const Stretch& own, Index joint, const VectorXd& beta) {
    const auto i = static_cast<std::size_t>(own.recording);
    if (!states_[i]) states_[i] = std::make_unique<JointStates>(untrimmed(*recordings_[i]));
    for (std::size_t r = 0; r < states_[i]->runs.size(); ++r) {
      const Motion& run = states_[i]->runs[r];
      const Index first = own.first - states_[i]->first_rows[r];
      if (first < 0 || first + own.count > run.samples()) continue;
      return model_
          .torque(run.q.middleRows(first, own.count), run.dq.middleRows(first, own.count),
                  run.ddq.middleRows(first, own.count), beta)
          .col(joint);
    }
    return VectorXd::Zero(own.count);
  }

 private:
  static JointStates untrimmed(const Recording& recording) {
    JointStateOptions options;
    options.trim = 0;
    return joint_states(recording, options);
  }

  const LinearModel& model_;
  const std::vector<std::shared_ptr<const Recording>>& recordings_;
  std::vector<std::unique_ptr<JointStates>> states_;
};

/// Recordings that are in memory with a torque.
std::vector<std::shared_ptr<const Recording>> usable(const std::vector<MotionSource>& sources,
                                                     SteadyJoints& answer) {
  std::vector<std::shared_ptr<const Recording>> recordings;
  for (const MotionSource& source : sources) {
    if (!source.recorded) {
      answer.remarks.push_back(fmt::format(
          "{} is too large to be in memory; its runs of constant speed are not looked for.",
          source.name));
      continue;
    }
    if (source.recorded->tau.size() > 0) recordings.push_back(source.recorded);
  }
  return recordings;
}

bool torque_is_dead(const std::vector<MotionSource>& sources, Index joint) {
  return std::any_of(sources.begin(), sources.end(), [&](const MotionSource& source) {
    const std::vector<bool>& dead = source.condition.torque_dead;
    return static_cast<std::size_t>(joint) < dead.size() && dead[static_cast<std::size_t>(joint)];
  });
}

}  // namespace

SteadyJoints steady_of(const DescribedRobot& robot, const VectorXd& beta,
                       const std::vector<MotionSource>& sources, ProgressLine& progress) {
  SteadyJoints answer;
  const LinearModel& model = robot.linear;
  const auto recordings = usable(sources, answer);
  if (recordings.empty()) return {};
  const SteadyRules rules;
  RestTorque rest(model, recordings);
  for (Index j = 0; j < model.joints(); ++j) {
    progress.show(fmt::format("steady speeds of joint {}", j + 1), static_cast<std::size_t>(j),
                  static_cast<std::size_t>(model.joints()));
    if (torque_is_dead(sources, j)) continue;
    SteadyInput input{recordings, j, model.revolute[static_cast<std::size_t>(j)], {}};
    if (beta.size() == model.size()) {
      input.rest = [&rest, j, own = without_friction(model, beta, j)](const Stretch& stretch) {
        return rest(stretch, j, own);
      };
    }
    SteadyResult result = analyse_steady(input, rules);
    if (result.runs >= kFewestRuns || !result.poses.pairs.empty()) {
      answer.joints.push_back(std::move(result));
    }
  }
  if (answer.joints.empty()) return {};
  return answer;
}

}  // namespace dyngen::runtime
