// SPDX-License-Identifier: MIT
#include "runtime/effects/model_triangles.h"

#include <Eigen/QR>
#include <utility>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Q' of the reflections, applied to columns.
void reflect(const MatrixXd& reflected, const VectorXd& sizes, MatrixXd& columns) {
  const Index rows = columns.rows();
  for (Index i = 0; i < sizes.size(); ++i) {
    const auto v = reflected.col(i).tail(rows - i - 1);
    for (Index c = 0; c < columns.cols(); ++c) {
      auto below = columns.col(c).tail(rows - i - 1);
      const double part = sizes[i] * (columns(i, c) + v.dot(below));
      columns(i, c) -= part;
      below -= part * v;
    }
  }
}

/// The triangle of [model | columns], with a diagonal that is not negative.
/// @param columns  (N x m) reflected
MatrixXd triangle_beside(const MatrixXd& reflected, const MatrixXd& columns) {
  const Index k = reflected.cols(), m = columns.cols();
  MatrixXd R = MatrixXd::Zero(k + m, k + m);
  R.topLeftCorner(k, k) = reflected.topRows(k).triangularView<Eigen::Upper>();
  R.topRightCorner(k, m) = columns.topRows(k);
  for (Index i = 0; i < k; ++i) {
    if (R(i, i) < 0) R.row(i) = -R.row(i);
  }
  R.bottomRightCorner(m, m) = triangle_of(columns.bottomRows(columns.rows() - k));
  return R;
}

bool is_late(const EffectInstance& effect) { return effect.law.kind == EffectKind::kAlignment; }

bool reads_model(const EffectInstance& effect) {
  for (const std::string& name : effect.law.variables) {
    if (depends_on_model(name)) return true;
  }
  return false;
}

/// What is asked of each joint at a point.
enum class Work { kNothing, kEffects, kAll };

std::vector<Work> work_of(const EffectRecordings& data, const EffectPoint& point) {
  std::vector<Work> work(static_cast<std::size_t>(data.joints()), Work::kNothing);
  for (const EffectInstance& effect : point.effects) {
    const Work own = is_late(effect) || reads_model(effect) ? Work::kAll : Work::kEffects;
    for (const int j : joints_of(effect, data.joints())) {
      Work& of_joint = work[static_cast<std::size_t>(j)];
      of_joint = std::max(of_joint, own);
    }
  }
  return work;
}

}  // namespace

ModelTriangles::ModelTriangles(const EffectRecordings& data)
    : data_(data), joints_(static_cast<std::size_t>(data.joints())) {}

const ModelTriangles::Joint& ModelTriangles::joint(int j, bool reflections) {
  std::optional<Joint>& kept = joints_[static_cast<std::size_t>(j)];
  if (kept && (!reflections || kept->reflected.size() > 0)) return *kept;
  const std::vector<int>& columns = data_.model.columns[static_cast<std::size_t>(j)];
  const auto k = static_cast<Index>(columns.size());
  Joint made;
  made.reflected.resize(data_.equations(), k);
  MatrixXd torque(data_.equations(), 1);
  made.alone.rows = 0;
  Index start = 0;
  for (const EffectRun& run : data_.runs) {
    const RowBlock& rows = run.rows;
    const Index count = rows.Y.rows();
    const auto counted = rows.counted.col(j);
    for (Index i = 0; i < k; ++i) {
      const int column = columns[static_cast<std::size_t>(i)];
      made.reflected.col(i).segment(start, count) =
          rows.Y.col(Index{j} * data_.model.size() + column).cwiseProduct(counted);
    }
    torque.col(0).segment(start, count) = rows.tau.col(j).cwiseProduct(counted);
    made.alone.rows += counted.sum();
    start += count;
  }
  if (made.reflected.rows() > k) {
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(made.reflected);
    made.sizes = qr.hCoeffs();
    reflect(made.reflected, made.sizes, torque);
    made.alone.R = triangle_beside(made.reflected, torque);
  } else {
    MatrixXd both(made.reflected.rows(), k + 1);
    both << made.reflected, torque;
    made.alone.R = triangle_in_place(both);
  }
  if (!reflections) made.reflected.resize(0, 0);
  kept = std::move(made);
  return *kept;
}

TorqueFactor ModelTriangles::at(EffectSignals& signals, const EffectPoint& point,
                                const EffectUnknowns& unknowns) {
  std::vector<Work> work = work_of(data_, point);
  std::vector<bool> whole, beside;
  for (int j = 0; j < data_.joints(); ++j) {
    Work& of_joint = work[static_cast<std::size_t>(j)];
    const std::size_t model = data_.model.columns[static_cast<std::size_t>(j)].size();
    // fewer equations than columns have no reflections that would be kept
    const bool few = data_.equations() <= static_cast<Index>(model);
    if (of_joint == Work::kEffects && few) of_joint = Work::kAll;
    whole.push_back(of_joint == Work::kAll);
    beside.push_back(of_joint == Work::kEffects);
  }
  PointEquations equations = equations_at(data_, signals, point, unknowns, whole, beside);
  TorqueFactor factor;
  factor.parameters = unknowns.size;
  factor.columns = std::move(equations.columns);
  for (int j = 0; j < data_.joints(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    if (work[place] == Work::kNothing) {
      factor.joints.push_back(joint(j, false).alone);
    } else if (work[place] == Work::kAll) {
      const auto size = static_cast<Index>(factor.columns[place].size()) + 1;
      JointFactor own{MatrixXd::Zero(size, size), 0};
      for (JointRows& rows : equations.joints[place]) {
        const double counted = own.rows + rows.counted;
        absorb(own, rows.A);
        own.rows = counted;
      }
      factor.joints.push_back(std::move(own));
    } else {
      const Joint& kept = joint(j, true);
      Index width = 0;
      for (const JointRows& rows : equations.joints[place]) width = rows.A.cols();
      MatrixXd columns(data_.equations(), width);
      Index start = 0;
      for (const JointRows& rows : equations.joints[place]) {
        columns.middleRows(start, rows.A.rows()) = rows.A;
        start += rows.A.rows();
      }
      reflect(kept.reflected, kept.sizes, columns);
      factor.joints.push_back({triangle_beside(kept.reflected, columns), kept.alone.rows});
    }
  }
  return factor;
}

}  // namespace dyngen::runtime
