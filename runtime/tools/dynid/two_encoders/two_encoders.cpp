// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "gen/model/chi.h"
#include "runtime/estimation/covariance.h"
#include "runtime/identification/summary.h"
#include "runtime/import/map_file.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/signals/joint_state.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostModelRows = 20000;  // of which the model's noise is taken: it is smooth
constexpr Index kBlock = 4096;           // samples of which the regressor is held at once

/// Places among the parameters that make the load of a joint: bodies, not rotors or friction.
std::vector<int> load_places(const LinearModel& model, int joint) {
  std::vector<int> places;
  for (const int place : model.columns[static_cast<std::size_t>(joint)]) {
    if (model.parameters[static_cast<std::size_t>(place)].kind == ParameterKind::kInertial) {
      places.push_back(place);
    }
  }
  return places;
}

/// Whether the rotor of a joint is grouped with bodies.
bool rotor_is_grouped(const DescribedRobot& robot, int joint) {
  constexpr Index kPerLink = 14;
  Index link = -1;
  for (std::size_t i = 0; i < robot.model.joints.size(); ++i) {
    if (robot.model.joints[i].coordinate == joint) link = static_cast<Index>(i);
  }
  if (link < 0) return false;
  const Index column = kPerLink * link + static_cast<Index>(Chi::kIA);
  if (column >= robot.grouping.cols()) return false;
  for (const int place : load_places(robot.linear, joint)) {
    if (robot.grouping(place, column) != 0) return true;
  }
  return false;
}

/// What one joint gives of all recordings, and the derivatives of its load on some rows.
struct JointSamples {
  WindUpData data;
  MatrixXd derivatives;        ///< (M x p) of every `stride`-th sample
  std::vector<Index> sampled;  ///< which they are
  std::vector<double> wind_up, q, dq, ddq, load;
};

VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// The inertial torque of all joints and, of some rows, its derivatives.
class LoadEvaluation {
 public:
  LoadEvaluation(const LinearModel& model, const VectorXd& beta) : model_(model), beta_(beta) {}

  /// @param keep  of joint, sample within the block and derivatives (1 x p)
  template <typename Keep>
  MatrixXd operator()(const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq,
                      const std::vector<int>& joints, const Keep& keep) {
    const Index nb = model_.size();
    MatrixXd load = MatrixXd::Zero(q.rows(), model_.joints());
    if (model_.held) load = model_.held->torque(q, dq, ddq, true);
    if (nb == 0) return load;
    model_.regressor(q, dq, ddq, Y_);
    for (const int joint : joints) {
      const std::vector<int> places = load_places(model_, joint);
      for (const int place : places) {
        load.col(joint) += beta_[place] * Y_.col(joint * nb + place);
      }
      keep(joint, places, Y_);
    }
    return load;
  }

 private:
  const LinearModel& model_;
  const VectorXd& beta_;
  MatrixXd Y_;
};

/// The joint state of a recording at the cut-off that its source has.
JointStates states_of(const MotionSource& source, const ToolOptions& options) {
  JointStateOptions state = options.motion.state;
  if (source.cutoff.hz > 0) state.cutoff_hz = source.cutoff.hz;
  return joint_states(*source.recorded, state);
}

Index samples_of(const std::vector<MotionSource>& sources) {
  Index samples = 0;
  for (const MotionSource& source : sources) {
    if (source.recorded && source.recorded->q_link.size() > 0)
      samples += source.recorded->samples();
  }
  return samples;
}

/// A weighted fit of the rigid robot.
LoadModel fitted_load(const LinearModel& model, const std::vector<MotionSource>& sources,
                      const RowOptions& options) {
  RecordingSummary all = empty_summary(model.columns, model.size());
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources) {
    merge(all, summarise_without_noise(model, source, options));
    rows.push_back(rows_of(model, source, options));
  }
  const Estimate fit = weighted_least_squares(all.equations);
  const NoiseFactor noise = noise_at(fit, all.equations, joined(std::move(rows)));
  return {fit.beta,
          correlated_covariance(all.equations, noise, fit.joint_weights, fit.scale, fit.unseen)};
}

/// Behind a low-pass below which links are rigid; a cut-off that was told stays.
std::vector<MotionSource> slow_enough(const std::vector<MotionSource>& sources) {
  std::vector<MotionSource> slow;
  for (const MotionSource& source : sources) {
    if (!source.others.at || !(source.cutoff.hz > kHighestLoadCutoff)) {
      slow.push_back(source);
      continue;
    }
    constexpr double kOwnTrim = -1;
    slow.push_back(source.others.at({kHighestLoadCutoff, "of rigid links"}, kOwnTrim));
    slow.back().recorded = source.recorded;
  }
  return slow;
}

/// Of both encoders of a joint, rad or m; 0: none was found.
double coarser_step(const std::vector<MotionSource>& sources, int joint) {
  double step = 0;
  for (const MotionSource& source : sources) {
    if (!source.recorded || !source.recorded->has_link(joint)) continue;
    for (const MatrixXd* positions : {&source.recorded->q, &source.recorded->q_link}) {
      step = std::max(step, find_quantisation(positions->col(joint)).step);
    }
  }
  return step;
}

}  // namespace

std::vector<int> joints_with_two_encoders(const std::vector<MotionSource>& sources) {
  std::vector<int> joints;
  for (const MotionSource& source : sources) {
    if (!source.recorded) continue;
    for (int j = 0; j < source.recorded->joints(); ++j) {
      if (!source.recorded->has_link(j)) continue;
      if (std::find(joints.begin(), joints.end(), j) == joints.end()) joints.push_back(j);
    }
  }
  std::sort(joints.begin(), joints.end());
  return joints;
}

std::vector<double> gears_of_map(const ToolOptions& options) {
  return options.map.empty() ? std::vector<double>() : read_import_map(options.map).gears;
}

TwoEncoders two_encoders_of(const DescribedRobot& robot, const std::optional<LoadModel>& given,
                            const std::vector<MotionSource>& all_sources,
                            const ToolOptions& options, const WindUpRules& rules,
                            ProgressLine& progress) {
  TwoEncoders answer;
  const std::vector<int> joints = joints_with_two_encoders(all_sources);
  if (joints.empty()) return answer;
  const LinearModel& model = robot.linear;
  progress.show("load of the gears", 0, 1);
  const std::vector<MotionSource> sources = slow_enough(all_sources);
  const LoadModel load = given ? *given : fitted_load(model, sources, options.rows);
  const Index stride = 1 + samples_of(sources) / kMostModelRows;
  std::vector<JointSamples> all(joints.size());
  LoadEvaluation evaluate(model, load.beta);
  double sample_time = 0, bandwidth = 0;
  for (const MotionSource& source : sources) {
    if (!source.recorded || source.recorded->q_link.size() == 0) continue;
    progress.show("wind-up of " + source.name, 0, 1);
    const Recording& recording = *source.recorded;
    const JointStates states = states_of(source, options);
    if (states.stands) continue;
    for (std::size_t r = 0; r < states.runs.size(); ++r) {
      const Motion& run = states.runs[r];
      constexpr double kSame = 1e-3;
      if (sample_time == 0) {
        sample_time = run.sample_time;
        bandwidth = states.cutoff.hz;
      } else if (std::abs(run.sample_time / sample_time - 1) > kSame) {
        answer.remarks.push_back(fmt::format(
            "{} has another sample time than the recordings before it; its wind-up is left out.",
            source.name));
        break;
      }
      for (std::size_t i = 0; i < joints.size(); ++i) {
        if (recording.has_link(joints[i])) {
          all[i].data.run_starts.push_back(static_cast<Index>(all[i].q.size()));
        }
      }
      for (Index first = 0; first < run.samples(); first += kBlock) {
        const Index count = std::min(kBlock, run.samples() - first);
        const auto keep = [&](int joint, const std::vector<int>& places, const MatrixXd& Y) {
          const auto own = static_cast<std::size_t>(std::find(joints.begin(), joints.end(), joint) -
                                                    joints.begin());
          if (!recording.has_link(joint) || load.covariance.size() == 0) return;
          JointSamples& samples = all[own];
          for (Index k = 0; k < count; k += stride) {
            const Index at = samples.derivatives.rows();
            samples.sampled.push_back(static_cast<Index>(samples.q.size()) + k);
            if (static_cast<Index>(samples.sampled.size()) > at) {
              constexpr Index kFewest = 1024;
              samples.derivatives.conservativeResize(std::max(kFewest, 2 * at),
                                                     static_cast<Index>(places.size()));
            }
            for (std::size_t p = 0; p < places.size(); ++p) {
              samples.derivatives(static_cast<Index>(samples.sampled.size()) - 1,
                                  static_cast<Index>(p)) =
                  Y(k, static_cast<Index>(joint) * model.size() + places[p]);
            }
          }
        };
        const MatrixXd torque =
            evaluate(run.q.middleRows(first, count), run.dq.middleRows(first, count),
                     run.ddq.middleRows(first, count), joints, keep);
        for (std::size_t i = 0; i < joints.size(); ++i) {
          const int j = joints[i];
          if (!recording.has_link(j)) continue;
          for (Index k = 0; k < count; ++k) {
            const Index row = states.first_rows[r] + first + k;
            all[i].wind_up.push_back(recording.q(row, j) - recording.q_link(row, j));
            all[i].q.push_back(run.q(first + k, j));
            all[i].dq.push_back(run.dq(first + k, j));
            all[i].ddq.push_back(run.ddq(first + k, j));
            all[i].load.push_back(torque(k, j));
          }
        }
      }
    }
  }
  const std::vector<double> gears = gears_of_map(options);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    progress.show(fmt::format("wind-up of joint {}", joints[i] + 1), i, joints.size());
    JointSamples& own = all[i];
    WindUpData& data = own.data;
    // the first start stands there already
    if (data.run_starts.size() > 1) data.run_starts.erase(data.run_starts.begin());
    data.sample_time = sample_time > 0 ? sample_time : 1;
    data.bandwidth = bandwidth;
    data.wind_up = vector_of(own.wind_up);
    data.q = vector_of(own.q);
    data.dq = vector_of(own.dq);
    data.ddq = vector_of(own.ddq);
    data.load = vector_of(own.load);
    data.revolute = model.revolute[static_cast<std::size_t>(joints[i])];
    data.position_step = coarser_step(sources, joints[i]);
    data.gear_ratio = of_joint(gears, static_cast<std::size_t>(joints[i]), 0);
    data.rotor_open = rotor_is_grouped(robot, joints[i]);
    const std::vector<int> places = load_places(model, joints[i]);
    if (!own.sampled.empty() && !places.empty()) {
      const auto rows = static_cast<Index>(own.sampled.size());
      const auto derivatives = std::make_shared<const MatrixXd>(own.derivatives.topRows(rows));
      const double factor = static_cast<double>(data.q.size()) / static_cast<double>(rows);
      data.load_covariance = load.covariance(places, places);
      data.load_products = [derivatives, factor, sampled = own.sampled](const MatrixXd& D) {
        return LoadProducts{factor * D(sampled, Eigen::all).transpose() * *derivatives,
                            factor * derivatives->transpose() * *derivatives};
      };
    }
    answer.joints.push_back(analyse_wind_up(data, rules));
    answer.joints.back().joint = joints[i];
  }
  return answer;
}

}  // namespace dyngen::runtime
