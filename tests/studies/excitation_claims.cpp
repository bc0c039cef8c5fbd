// SPDX-License-Identifier: MIT
#include "tests/studies/excitation_claims.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <stdexcept>

#include "gen/symbols/exact.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::DescribedRobot;
using runtime::JointMotion;
using runtime::LinearModel;

std::string in_project(const std::string& path) {
  return std::string(DYNGEN_SOURCE_DIR "/") + path;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

JointMotion period(const runtime::TrajectoryFamily& family, const MatrixXd& x, Index samples) {
  return runtime::basis_at(family, runtime::period_times(family, samples)).motion(x);
}

/// The limits of the robot's file in robots/, torque foretold by the truth.
runtime::MotionLimits real_limits(const std::string& name, const VectorXd& beta) {
  const std::string file = name == "puma3" ? "puma560_3dof" : name;
  const DescribedRobot robot = runtime::describe_robot(in_project("robots/" + file + ".robot"),
                                                       runtime::OpenParameters::kAbsentRows);
  runtime::MotionLimits limits = runtime::limits_of(robot, {}).limits;
  limits.beta = beta;
  return limits;
}

/// Weighted least squares with known weights, made ready for many noisy torques of one motion.
struct Estimator {
  MatrixXd W;         ///< stacked rows over their noise
  MatrixXd solution;  ///< (nb x rows)
};

Estimator estimator_of(const LinearModel& model, const JointMotion& motion,
                       const VectorXd& torque_noise) {
  MatrixXd Y;
  model.regressor(motion.q, motion.dq, motion.ddq, Y);
  const Index samples = motion.q.rows(), size = model.size();
  Estimator estimator;
  estimator.W.resize(samples * model.joints(), size);
  for (Index j = 0; j < model.joints(); ++j) {
    estimator.W.middleRows(j * samples, samples) = Y.middleCols(j * size, size) / torque_noise[j];
  }
  estimator.solution = runtime::pseudo_inverse(estimator.W);
  return estimator;
}

/// What the judge says, joint after joint, over the noise.
VectorXd weighed_torque(const NumericRobot& robot, const JointMotion& motion,
                        const VectorXd& torque_noise) {
  const Index samples = motion.q.rows(), joints = motion.q.cols();
  VectorXd tau(samples * joints);
  const auto values = [&](const MatrixXd& matrix, Index k) {
    const VectorXd row = matrix.row(k);
    return std::vector<double>(row.begin(), row.end());
  };
  for (Index k = 0; k < samples; ++k) {
    const std::vector<double> torque =
        id(robot, values(motion.q, k), values(motion.dq, k), values(motion.ddq, k));
    for (Index j = 0; j < joints; ++j) {
      tau[j * samples + k] = torque[static_cast<std::size_t>(j)] / torque_noise[j];
    }
  }
  return tau;
}

/// Mean squares of the estimates' errors over noise of several seeds.
VectorXd error_squares(const Estimator& estimator, const VectorXd& tau, const VectorXd& truth,
                       int seeds, std::uint64_t first_seed) {
  VectorXd squares = VectorXd::Zero(estimator.W.cols());
  for (int i = 0; i < seeds; ++i) {
    std::mt19937_64 random(first_seed + static_cast<std::uint64_t>(i));
    std::normal_distribution<double> normal;
    const VectorXd noise = VectorXd::NullaryExpr(tau.size(), [&] { return normal(random); });
    const VectorXd estimate = estimator.solution * (tau + noise);
    squares += (estimate - truth).cwiseAbs2() / seeds;
  }
  return squares;
}

}  // namespace

ConditionFigures condition_figures(const ConditionStudy& study) {
  const DescribedRobot robot = runtime::describe_robot(
      in_project(study.robot), runtime::OpenParameters::kAbsentRows, {.gradient = true});
  const runtime::MotionLimits limits = runtime::limits_of(robot, {}).limits;
  runtime::ExcitationOptions options = study.options;
  for (int i = 0; i < robot.linear.size(); ++i) {
    const bool inertial = robot.linear.parameters[static_cast<std::size_t>(i)].kind ==
                          runtime::ParameterKind::kInertial;
    if (inertial || !study.inertial_only) options.information.parameters.push_back(i);
  }
  constexpr Index kSamples = 2000;
  const auto condition = [&](const MatrixXd& x, bool unit_columns) {
    return runtime::condition_number(robot.linear, period(options.family, x, kSamples),
                                     options.information.parameters, unit_columns);
  };
  ConditionFigures figures;
  figures.parameters = static_cast<int>(options.information.parameters.size());
  std::vector<double> randoms;
  for (int i = 0; i < study.randoms; ++i) {
    const MatrixXd x = runtime::random_trajectory(robot.linear, limits, options.family,
                                                  1000 + static_cast<std::uint64_t>(i));
    randoms.push_back(condition(x, false));
  }
  figures.random_median = median(randoms);
  figures.random_best = *std::min_element(randoms.begin(), randoms.end());
  const auto begin = std::chrono::steady_clock::now();
  const runtime::Excitation excitation = runtime::excite(robot.linear, limits, options);
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.evaluations = excitation.evaluations;
  figures.found = excitation.found;
  figures.shares = excitation.shares;
  figures.optimised = condition(excitation.x, false);
  figures.unit_columns = condition(excitation.x, true);
  return figures;
}

ThesisArm thesis_arm() {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  ThesisArm arm;
  arm.robot = runtime::describe_robot(in_project("robots/puma560_3dof.robot"),
                                      runtime::OpenParameters::kAsWritten, {.gradient = true});
  arm.limits = runtime::limits_of(arm.robot, {}).limits;
  // Table 5.1 has neither speeds nor accelerations
  arm.limits.speed.setConstant(kNone);
  arm.limits.acceleration.setConstant(kNone);
  for (const char* name : {"MX2", "MY2", "MX3", "MY3", "ZZ3", "XY3", "XZ3", "YZ3"}) {
    const auto& parameters = arm.robot.linear.parameters;
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const auto& parameter) {
          // a grouped parameter has an R behind its letters
          std::string plain = parameter.name;
          std::erase(plain, 'R');
          return plain == name;
        });
    if (found == parameters.end()) throw std::logic_error(name);
    arm.parameters.push_back(static_cast<int>(found - parameters.begin()));
  }
  std::sort(arm.parameters.begin(), arm.parameters.end());
  return arm;
}

double EstimateComparison::median_ratio() const {
  std::vector<double> ratios;
  for (Index i = 0; i < random_rms.size(); ++i) ratios.push_back(random_rms[i] / optimised_rms[i]);
  return median(ratios);
}

EstimateComparison compare_estimates(const EstimateStudy& study) {
  const std::string path = in_project("tests/studies/robots/" + study.robot + ".robot");
  const StudyRobot robot = study_robot(study.robot);
  const DescribedRobot described =
      runtime::describe_robot(path, runtime::OpenParameters::kAsWritten, {.gradient = true});
  const LinearModel& model = described.linear;
  const VectorXd beta = described.grouping * described.standard;
  const runtime::MotionLimits limits = real_limits(study.robot, beta);
  const VectorXd& noise = robot.loop.torque_noise;
  runtime::ExcitationOptions options = study.options;
  options.information.torque_noise = noise;
  options.information.samples = study.samples;

  EstimateComparison comparison;
  VectorXd squares = VectorXd::Zero(model.size());
  for (int i = 0; i < study.motions; ++i) {
    const MatrixXd x = runtime::random_trajectory(model, limits, options.family,
                                                  1000 + static_cast<std::uint64_t>(i));
    const JointMotion motion = period(options.family, x, study.samples);
    squares += error_squares(estimator_of(model, motion, noise),
                             weighed_torque(robot.truth, motion, noise), beta, study.seeds,
                             5000 + 100 * static_cast<std::uint64_t>(i)) /
               study.motions;
  }
  comparison.random_rms = squares.cwiseSqrt();
  const runtime::Excitation excitation = runtime::excite(model, limits, options);
  if (!excitation.found) throw std::runtime_error("compare_estimates(): " + excitation.message);
  const JointMotion motion = period(options.family, excitation.x, study.samples);
  comparison.optimised_rms =
      error_squares(estimator_of(model, motion, noise), weighed_torque(robot.truth, motion, noise),
                    beta, study.seeds * study.motions, 9000)
          .cwiseSqrt();
  comparison.predicted =
      runtime::standard_deviations(runtime::information_of(model, motion, options.information).R);
  return comparison;
}

}  // namespace dyngen::test
