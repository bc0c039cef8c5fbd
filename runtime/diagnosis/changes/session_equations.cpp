// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/session_equations.h"

#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kTogether = 4096;  // rows that join a triangle at once: bounds memory, not accuracy

/// R of [R; rows].
void join(MatrixXd& R, const MatrixXd& rows) {
  const Index width = R.cols();
  for (Index from = 0; from < rows.rows(); from += kTogether) {
    const Index count = std::min(kTogether, rows.rows() - from);
    MatrixXd stacked(width + count, width);
    stacked << R, rows.middleRows(from, count);
    Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(stacked);
    R = stacked.topRows(width).triangularView<Eigen::Upper>();
  }
}

/// [regressor, further columns, torque] of one joint in one run, whitened.
MatrixXd whitened_rows(const RowBlock& block, int joint, const JointNoise& noise,
                       const JointColumns& further, Index start) {
  const Index rows = block.tau.rows();
  const Index nb = block.Y.cols() / block.tau.cols();
  MatrixXd A = MatrixXd::Zero(rows, nb + further.columns() + 1);
  A.leftCols(nb) = block.Y.middleCols(joint * nb, nb);
  for (std::size_t i = 0; i < further.joints.size(); ++i) {
    if (further.joints[i] != joint) continue;
    A.middleCols(nb, further.columns()) = further.parts[i].middleRows(start, rows);
  }
  A.rightCols(1) = block.tau.col(joint);
  const VectorXd counted = block.counted.col(joint);
  A.array().colwise() *= counted.array();
  Whitener(noise, counted).apply(A);
  return A;
}

}  // namespace

std::vector<SessionEquations> session_equations(const std::vector<RowBlock>& blocks,
                                                const SessionPlan& plan,
                                                const std::vector<JointNoise>& noise,
                                                const JointColumns& further) {
  std::vector<SessionEquations> sessions(static_cast<std::size_t>(plan.sessions()));
  const Index n = static_cast<Index>(noise.size());
  const Index width = blocks.front().Y.cols() / n + further.columns() + 1;
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    sessions[s].later = static_cast<int>(s) >= plan.reference;
    sessions[s].first = sessions[s].second = MatrixXd::Zero(width, width);
  }
  Index start = 0;
  for (std::size_t run = 0; run < blocks.size(); ++run) {
    SessionEquations& session = sessions[static_cast<std::size_t>(plan.of_run[run])];
    const Index rows = blocks[run].tau.rows(), half = rows / 2;
    for (int j = 0; j < n; ++j) {
      const JointNoise& own = noise[static_cast<std::size_t>(j)];
      if (!(own.deviation() > 0) || blocks[run].counted.col(j).sum() == 0) continue;
      const MatrixXd A = whitened_rows(blocks[run], j, own, further, start);
      join(session.first, A.topRows(half));
      join(session.second, A.bottomRows(rows - half));
    }
    start += rows;
  }
  for (SessionEquations& session : sessions) {
    session.triangle = session.first;
    join(session.triangle, session.second);
  }
  return sessions;
}

MatrixXd estimates_of_sessions(const std::vector<SessionEquations>& sessions, Index common) {
  MatrixXd estimates(common, static_cast<Index>(sessions.size()));
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    const MatrixXd& R = sessions[s].triangle;
    const VectorXd scale =
        R.leftCols(common).colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
    solver.setThreshold(1e-9);
    solver.compute(R.leftCols(common) * scale.asDiagonal());
    estimates.col(static_cast<Index>(s)) = scale.asDiagonal() * solver.solve(R.rightCols(1));
  }
  return estimates;
}

VectorXd torque_rms(const std::vector<RowBlock>& blocks) {
  VectorXd squares = VectorXd::Zero(blocks.front().tau.cols()), counts = squares;
  for (const RowBlock& block : blocks) {
    squares += block.tau.cwiseProduct(block.counted).colwise().squaredNorm().transpose();
    counts += block.counted.colwise().sum().transpose();
  }
  return squares.cwiseQuotient(counts.cwiseMax(1.0)).cwiseSqrt();
}

}  // namespace dyngen::runtime
