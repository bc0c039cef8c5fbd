// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/two_encoders/wind_up_samples.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBlock = 4096;       // samples of which the regressor is held at once
constexpr Index kFewestRows = 1024;  // of derivatives, for which room is made
constexpr double kSameSampleTime = 1e-3;

VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace

std::vector<int> load_places(const LinearModel& model, int joint) {
  std::vector<int> places;
  for (const int place : model.columns[static_cast<std::size_t>(joint)]) {
    if (model.parameters[static_cast<std::size_t>(place)].kind == ParameterKind::kInertial) {
      places.push_back(place);
    }
  }
  return places;
}

WindUpSamples::WindUpSamples(const LinearModel& model, const LoadModel& load,
                             std::vector<int> joints, Index stride)
    : model_(model),
      load_(load),
      joints_(std::move(joints)),
      stride_(stride),
      all_(joints_.size()) {}

bool WindUpSamples::add(const Recording& recording, const JointStates& states) {
  for (std::size_t r = 0; r < states.runs.size(); ++r) {
    const Motion& run = states.runs[r];
    if (sample_time_ == 0) {
      sample_time_ = run.sample_time;
      bandwidth_ = states.cutoff.hz;
    } else if (std::abs(run.sample_time / sample_time_ - 1) > kSameSampleTime) {
      return false;
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (!recording.has_link(joints_[i])) continue;
      all_[i].run_starts.push_back(static_cast<Index>(all_[i].q.size()));
    }
    for (Index first = 0; first < run.samples(); first += kBlock) {
      add_block(recording, run, states.first_rows[r], first,
                std::min(kBlock, run.samples() - first));
    }
  }
  return true;
}

void WindUpSamples::add_block(const Recording& recording, const Motion& run, Index run_row,
                              Index first, Index count) {
  Motion block;
  block.time = run.time.segment(first, count);
  block.q = run.q.middleRows(first, count);
  block.dq = run.dq.middleRows(first, count);
  block.ddq = run.ddq.middleRows(first, count);
  const MatrixXd torque = load_of(block);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const int j = joints_[i];
    if (!recording.has_link(j)) continue;
    OfJoint& own = all_[i];
    if (load_.covariance.size() > 0) keep_derivatives(own, j, count);
    for (Index k = 0; k < count; ++k) {
      const Index row = run_row + first + k;
      own.wind_up.push_back(recording.q(row, j) - recording.q_link(row, j));
      own.q.push_back(block.q(k, j));
      own.dq.push_back(block.dq(k, j));
      own.ddq.push_back(block.ddq(k, j));
      own.load.push_back(torque(k, j));
    }
  }
}

/// The inertial torque of the joints, whose regressor stays in Y_.
MatrixXd WindUpSamples::load_of(const Motion& block) {
  const Index nb = model_.size();
  MatrixXd load = MatrixXd::Zero(block.samples(), model_.joints());
  if (model_.held) load = model_.held->torque(block.q, block.dq, block.ddq, true);
  if (nb == 0) return load;
  model_.regressor(block.q, block.dq, block.ddq, Y_);
  for (const int joint : joints_) {
    for (const int place : load_places(model_, joint)) {
      load.col(joint) += load_.beta[place] * Y_.col(joint * nb + place);
    }
  }
  return load;
}

void WindUpSamples::keep_derivatives(OfJoint& samples, int joint, Index count) const {
  const std::vector<int> places = load_places(model_, joint);
  for (Index k = 0; k < count; k += stride_) {
    const auto row = static_cast<Index>(samples.sampled.size());
    samples.sampled.push_back(static_cast<Index>(samples.q.size()) + k);
    if (row >= samples.derivatives.rows()) {
      samples.derivatives.conservativeResize(std::max(kFewestRows, 2 * row),
                                             static_cast<Index>(places.size()));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
      samples.derivatives(row, static_cast<Index>(p)) =
          Y_(k, static_cast<Index>(joint) * model_.size() + places[p]);
    }
  }
}

WindUpData WindUpSamples::data(std::size_t place) const {
  const OfJoint& own = all_[place];
  WindUpData data;
  if (!own.run_starts.empty()) data.run_starts = own.run_starts;
  data.sample_time = sample_time_ > 0 ? sample_time_ : 1;
  data.bandwidth = bandwidth_;
  data.wind_up = vector_of(own.wind_up);
  data.q = vector_of(own.q);
  data.dq = vector_of(own.dq);
  data.ddq = vector_of(own.ddq);
  data.load = vector_of(own.load);
  const std::vector<int> places = load_places(model_, joints_[place]);
  if (own.sampled.empty() || places.empty()) return data;
  const auto rows = static_cast<Index>(own.sampled.size());
  const auto derivatives = std::make_shared<const MatrixXd>(own.derivatives.topRows(rows));
  const double factor = static_cast<double>(data.q.size()) / static_cast<double>(rows);
  data.load_covariance = load_.covariance(places, places);
  data.load_products = [derivatives, factor, sampled = own.sampled](const MatrixXd& D) {
    return LoadProducts{factor * D(sampled, Eigen::all).transpose() * *derivatives,
                        factor * derivatives->transpose() * *derivatives};
  };
  return data;
}

}  // namespace dyngen::runtime
