// SPDX-License-Identifier: MIT
#include "tests/studies/repetition.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::FitMethod;
using runtime::InstrumentBlock;
using runtime::MethodFit;
using runtime::MotionSource;
using runtime::Recording;
using runtime::RowBlock;
using runtime::RowSource;
using runtime::StreamPiece;

namespace {

using Blocks = std::shared_ptr<const std::vector<RowBlock>>;

Blocks collected(const RowSource& source) {
  auto blocks = std::make_shared<std::vector<RowBlock>>();
  source([&](const RowBlock& block) { blocks->push_back(block); });
  return blocks;
}

/// The motion that was asked for, at the times of the equations that were measured.
MotionSource asked_for(const MotionSource& measured, const FourierMotion& reference) {
  MotionSource source = measured;
  source.pieces = [pieces = measured.pieces, reference](const auto& visit) {
    pieces([&](StreamPiece piece) {
      for (Index k = 0; k < piece.motion.samples(); ++k) {
        const FourierMotion::State state = reference.at(piece.motion.time[k]);
        piece.motion.q.row(k) = state.q;
        piece.motion.dq.row(k) = state.dq;
        piece.motion.ddq.row(k) = state.ddq;
      }
      visit(piece);
    });
  };
  return source;
}

/// Z with zeros where the measured equation is left out.
MatrixXd instruments(const RowBlock& rows, const RowBlock& asked, Index parameters) {
  if (asked.Y.rows() != rows.Y.rows()) throw std::logic_error("instruments of other rows");
  MatrixXd Z = asked.Y;
  if (rows.counted.size() == 0) return Z;
  for (Index j = 0; j < rows.tau.cols(); ++j) {
    const VectorXd counted = rows.counted.col(j);
    Z.middleCols(j * parameters, parameters).array().colwise() *= counted.array();
  }
  return Z;
}

double part_within(const std::vector<double>& errors, double interval) {
  if (errors.empty()) return std::numeric_limits<double>::quiet_NaN();
  double inside = 0;
  for (const double error : errors) inside += error <= interval ? 1 : 0;
  return inside / static_cast<double>(errors.size());
}

}  // namespace

FourierMotion study_motion(const StudyRobot& robot, const MotionPlan& plan, unsigned seed) {
  MotionLimits limits = robot.limits;
  limits.reach *= plan.amplitude;
  limits.speed *= plan.amplitude;
  limits.acceleration *= plan.amplitude;
  if (plan.repeats) return random_motion(limits, 0.1, {1, 2, 3, 4, 5}, 10, seed);
  return random_motion(limits, 0.03, {3, 7, 10, 13, 17}, 20, seed);
}

StudyData study_data(const StudyRobot& robot, const Recording& recording,
                     const FourierMotion* reference, const runtime::MotionOptions& options,
                     const runtime::RowOptions& rows) {
  const runtime::LinearModel& model = robot.described.linear;
  StudyData result;
  result.source = runtime::motion_of(recording, options);
  const Blocks blocks = collected(runtime::rows_of(model, result.source, rows));
  result.data.summary = runtime::summarise(model, result.source, rows);
  result.data.rows = [blocks](const std::function<void(const RowBlock&)>& visit) {
    for (const RowBlock& block : *blocks) visit(block);
  };
  if (reference == nullptr) return result;
  const runtime::RowPlan plan = runtime::plan_rows(result.source, rows);
  const Blocks asked =
      collected(runtime::rows_of(model, asked_for(result.source, *reference),
                                 {.decimation = plan.decimation, .still_speed = 0}));
  result.data.instruments = [blocks, asked, nb = Index{model.size()}](
                                const std::function<void(const InstrumentBlock&)>& visit) {
    for (std::size_t i = 0; i < blocks->size(); ++i) {
      visit({(*blocks)[i], instruments((*blocks)[i], asked->at(i), nb)});
    }
  };
  return result;
}

HeldoutMotion heldout_motion(const StudyRobot& robot) {
  const Recording clean =
      clean_recording(robot.truth, study_motion(robot, {.repeats = false}, 987654), 20, 0.04);
  const runtime::LinearModel& model = robot.described.linear;
  MatrixXd Y;
  model.regressor(clean.q, clean.dq, clean.ddq, Y);
  const Index samples = clean.samples(), n = model.joints(), nb = model.size();
  HeldoutMotion result{MatrixXd(samples * n, nb), VectorXd(samples * n)};
  for (Index j = 0; j < n; ++j) {
    result.Y.middleRows(j * samples, samples) = Y.middleCols(j * nb, nb);
    result.tau.segment(j * samples, samples) = clean.tau.col(j);
  }
  return result;
}

MethodScore score(const StudyRobot& robot, const runtime::TorqueFactor& equations,
                  const HeldoutMotion& heldout, const MethodFit& fit) {
  MethodScore result;
  result.method = fit.method;
  const VectorXd& beta = fit.estimate.beta;
  const VectorXd error = beta - robot.beta;
  result.torque_error = heldout.error(beta);
  const VectorXd norms =
      runtime::column_norms(equations, VectorXd::Ones(static_cast<Index>(equations.joints.size())));
  result.parameter_error = error.cwiseProduct(norms).norm() / robot.beta.cwiseProduct(norms).norm();
  result.condition = fit.estimate.condition;
  if (fit.estimate.covariance.size() != 0) {
    const VectorXd stddev = fit.stddev();
    for (Index i = 0; i < error.size(); ++i) {
      result.errors.push_back(std::abs(error[i]) / stddev[i]);
    }
  }
  for (Index i = 0; i < fit.textbook.size(); ++i) {
    result.textbook_errors.push_back(std::abs(error[i]) / fit.textbook[i]);
  }
  result.covered = part_within(result.errors, fit.interval);
  result.textbook_covered = part_within(result.textbook_errors, 1.96);
  if (fit.instrumental) result.p_value = fit.instrumental->p_value;
  return result;
}

std::vector<MethodScore> run_methods(const StudyRobot& robot, const StudyData& data,
                                     const HeldoutMotion& heldout,
                                     const std::vector<FitMethod>& methods,
                                     const runtime::FitOptions& options) {
  std::vector<MethodScore> scores;
  for (const FitMethod method : methods) {
    runtime::FitOptions one = options;
    one.methods = {method};
    const auto start = std::chrono::steady_clock::now();
    const MethodFit fit = runtime::fit_methods(robot.described.linear, data.data, one).front();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    scores.push_back(score(robot, data.data.summary.equations, heldout, fit));
    scores.back().seconds = took.count();
  }
  return scores;
}

VectorXd prior_of(const StudyRobot& robot, double part, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  VectorXd prior = robot.beta;
  for (double& value : prior) value *= 1 + part * normal(random);
  return prior;
}

}  // namespace dyngen::test
