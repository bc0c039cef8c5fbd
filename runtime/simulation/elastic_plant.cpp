// SPDX-License-Identifier: MIT
#include "runtime/simulation/elastic_plant.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSettlingIterations = 500;  // until the gears carry the links

/// The equations of a robot with springs; keeps buffers.
class ElasticRobot {
 public:
  ElasticRobot(PlantModel rigid, std::vector<ElasticJoint> joints)
      : rigid_(std::move(rigid)),
        joints_(std::move(joints)),
        n_(rigid_.joints),
        q_(n_),
        dq_(n_),
        ddq_(n_),
        zero_(VectorXd::Zero(n_)),
        torque_(n_),
        friction_(n_),
        push_(n_),
        M_(n_, n_) {}

  void forward(const double* q, const double* dq, const double* tau, double* ddq) {
    take_links(q, dq, nullptr);
    rigid_.rigid(q_.data(), dq_.data(), zero_.data(), torque_.data());
    rigid_.friction(dq, friction_.data());
    link_inertia();
    for (Index j = 0; j < n_; ++j) push_[j] = tau[j] - friction_[j] - torque_[j];
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Index j = joints_[i].joint;
      const double load = load_of(i, q, dq);
      push_[j] = tau[n_ + static_cast<Index>(i)] + load - torque_[j];
      ddq[j] = (tau[j] - friction_[j] - load) / joints_[i].rotor;
    }
    const Eigen::LLT<MatrixXd> factor(M_);
    if (factor.info() != Eigen::Success) {
      throw std::runtime_error(
          "the mass matrix of the links behind elastic joints is not positive definite");
    }
    factor.solveInPlace(push_);
    give(push_, ddq);
  }

  void rigid(const double* q, const double* dq, const double* ddq, double* tau) {
    take_links(q, dq, ddq);
    rigid_.rigid(q_.data(), dq_.data(), ddq_.data(), torque_.data());
    for (const ElasticJoint& joint : joints_) {
      torque_[joint.joint] -= joint.rotor * ddq_[joint.joint];
    }
    give(torque_, tau);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double load = load_of(i, q, dq);
      tau[n_ + static_cast<Index>(i)] -= load;
      tau[joints_[i].joint] = joints_[i].rotor * ddq[joints_[i].joint] + load;
    }
  }

  void mass_matrix(const double* q, double* M) {
    take_links(q, nullptr, nullptr);
    link_inertia();
    const Index size = n_ + static_cast<Index>(joints_.size());
    Map<MatrixXd> whole(M, size, size);  // symmetric: the order does not matter
    whole.setZero();
    std::vector<Index> place(static_cast<std::size_t>(n_));
    for (Index j = 0; j < n_; ++j) place[static_cast<std::size_t>(j)] = j;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      place[static_cast<std::size_t>(joints_[i].joint)] = n_ + static_cast<Index>(i);
      whole(joints_[i].joint, joints_[i].joint) = joints_[i].rotor;
    }
    whole(place, place) = M_;
  }

  void friction(const double* dq, double* tau) {
    rigid_.friction(dq, tau);
    std::fill_n(tau + n_, joints_.size(), 0.0);
  }

  /// Loads that the links need without acceleration are those of the twists that they make.
  VectorXd at_rest(const VectorXd& q, const VectorXd& dq) {
    VectorXd all(n_ + static_cast<Index>(joints_.size()));
    all.head(n_) = q;
    VectorXd links = q;
    for (int k = 0; k < kSettlingIterations; ++k) {
      rigid_.rigid(links.data(), dq.data(), zero_.data(), torque_.data());
      double moved = 0;
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        const Index j = joints_[i].joint;
        const double next = q[j] - joints_[i].spring.twist(torque_[j]).value;
        moved = std::max(moved, std::abs(next - links[j]));
        all[n_ + static_cast<Index>(i)] = links[j] = next;
      }
      if (moved <= 1e-14 * (1 + links.cwiseAbs().maxCoeff())) return all;
    }
    throw std::runtime_error("the springs of elastic joints are too soft to carry the links");
  }

 private:
  /// The rigid robot's coordinates: of the links.
  void take_links(const double* q, const double* dq, const double* ddq) {
    for (const auto& [from, to] : {std::pair{q, &q_}, {dq, &dq_}, {ddq, &ddq_}}) {
      if (from == nullptr) continue;
      std::copy_n(from, n_, to->begin());
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        (*to)[joints_[i].joint] = from[n_ + static_cast<Index>(i)];
      }
    }
  }
  /// Values of the rigid robot's coordinates to those of the links; drives of elastic joints stay.
  void give(const VectorXd& values, double* all) const {
    std::vector<bool> elastic(static_cast<std::size_t>(n_));
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      elastic[static_cast<std::size_t>(joints_[i].joint)] = true;
      all[n_ + static_cast<Index>(i)] = values[joints_[i].joint];
    }
    for (Index j = 0; j < n_; ++j) {
      if (!elastic[static_cast<std::size_t>(j)]) all[j] = values[j];
    }
  }
  void link_inertia() {
    rigid_.mass_matrix(q_.data(), M_.data());
    for (const ElasticJoint& joint : joints_) M_(joint.joint, joint.joint) -= joint.rotor;
  }
  [[nodiscard]] double load_of(std::size_t i, const double* q, const double* dq) const {
    const ElasticJoint& joint = joints_[i];
    const Index link = n_ + static_cast<Index>(i);
    const double load = joint.spring.load(q[joint.joint] - q[link]);
    const double stiffness = 1 / joint.spring.twist(load).slope;
    const double damping = 2 * kGearDamping * std::sqrt(stiffness * joint.inertia);
    return load + damping * (dq[joint.joint] - dq[link]);
  }

  PlantModel rigid_;
  std::vector<ElasticJoint> joints_;
  Index n_;
  VectorXd q_, dq_, ddq_, zero_, torque_, friction_, push_;
  MatrixXd M_;
};

void check_elastic(const PlantModel& rigid, const std::vector<ElasticJoint>& joints) {
  rigid.validate();
  std::vector<bool> seen(static_cast<std::size_t>(rigid.joints));
  for (const ElasticJoint& joint : joints) {
    if (joint.joint < 0 || joint.joint >= rigid.joints) {
      throw std::invalid_argument(
          fmt::format("elastic_plant(): joint {}, expected one of {}", joint.joint, rigid.joints));
    }
    if (seen[static_cast<std::size_t>(joint.joint)]) {
      throw std::invalid_argument(
          fmt::format("elastic_plant(): joint {} stands twice", joint.joint));
    }
    seen[static_cast<std::size_t>(joint.joint)] = true;
    if (!(joint.rotor > 0) || !(joint.inertia > 0)) {
      throw std::invalid_argument(fmt::format(
          "elastic_plant(): joint {} has a rotor of {} and links of {}, expected positive inertias",
          joint.joint, joint.rotor, joint.inertia));
    }
  }
}

}  // namespace

PlantModel elastic_plant(PlantModel rigid, std::vector<ElasticJoint> joints) {
  check_elastic(rigid, joints);
  PlantModel plant;
  plant.joints = rigid.joints + static_cast<int>(joints.size());
  plant.links.resize(static_cast<std::size_t>(rigid.joints));
  for (int j = 0; j < rigid.joints; ++j) plant.links[static_cast<std::size_t>(j)] = j;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    plant.links[static_cast<std::size_t>(joints[i].joint)] = rigid.joints + static_cast<int>(i);
  }
  plant.coulomb = VectorXd::Zero(plant.joints);
  plant.coulomb.head(rigid.joints) = rigid.coulomb;
  plant.effects = rigid.effects;
  plant.lag = rigid.lag;
  // a copy for each: its functions keep buffers, and a plant may be copied
  ElasticRobot robot(std::move(rigid), std::move(joints));
  plant.forward = [robot](const double* q, const double* dq, const double* tau,
                          double* ddq) mutable { robot.forward(q, dq, tau, ddq); };
  plant.rigid = [robot](const double* q, const double* dq, const double* ddq, double* tau) mutable {
    robot.rigid(q, dq, ddq, tau);
  };
  plant.mass_matrix = [robot](const double* q, double* M) mutable { robot.mass_matrix(q, M); };
  plant.friction = [robot](const double* dq, double* tau) mutable { robot.friction(dq, tau); };
  plant.at_rest = [robot](const VectorXd& q, const VectorXd& dq) mutable {
    return robot.at_rest(q, dq);
  };
  return plant;
}

}  // namespace dyngen::runtime
