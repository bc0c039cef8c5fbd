// SPDX-License-Identifier: MIT
#include <algorithm>
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <memory>
#include <string>

#include "tests/bench/peers.h"
#include "tests/support/central_inertia.h"

namespace dyngen::bench {
namespace {

using KDL::Frame, KDL::Rotation, KDL::Vector;

/// Rx(alpha) Tx(d): what stands before the joint's axis in modified frames.
Frame before_axis(const test::NumericJoint& joint) {
  return Frame(Rotation::RotX(joint.alpha), Vector(joint.d, 0, 0));
}

KDL::RigidBodyInertia inertia(const test::NumericJoint& joint) {
  const test::CentralInertia link = test::central_inertia(joint);
  return KDL::RigidBodyInertia(
      link.mass, Vector(link.com[0], link.com[1], link.com[2]),
      KDL::RotationalInertia(link.xx, link.yy, link.zz, link.xy, link.xz, link.yz));
}

/// Joints about z, KDL's fastest kind: each segment ends where the next axis stands.
KDL::Chain make_chain(const test::NumericRobot& robot) {
  KDL::Chain chain;
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const test::NumericJoint& joint = robot.joints[j];
    const Frame own(Rotation::RotZ(joint.theta), Vector(0, 0, joint.r));
    const Frame next = j + 1 < robot.size() ? before_axis(robot.joints[j + 1]) : Frame::Identity();
    chain.addSegment(KDL::Segment("link" + std::to_string(j + 1),
                                  KDL::Joint("joint" + std::to_string(j + 1), KDL::Joint::RotZ),
                                  own * next, next.Inverse() * inertia(joint)));
  }
  return chain;
}

std::vector<KDL::JntArray> arrays(const std::vector<double>& values, std::size_t joints) {
  std::vector<KDL::JntArray> result(kStates, KDL::JntArray(static_cast<unsigned>(joints)));
  for (std::size_t k = 0; k < kStates; ++k) {
    for (std::size_t j = 0; j < joints; ++j) {
      result[k](static_cast<unsigned>(j)) = values[k * joints + j];
    }
  }
  return result;
}

struct Kdl {
  Kdl(const test::NumericRobot& robot, const States& states)
      : chain(make_chain(robot)),
        gravity(-robot.base_acceleration[0], -robot.base_acceleration[1],
                -robot.base_acceleration[2]),
        id(chain, gravity),
        fd(chain, gravity),
        dynamics(chain, gravity),
        no_wrenches(robot.size(), KDL::Wrench::Zero()),
        result(static_cast<unsigned>(robot.size())),
        M(static_cast<int>(robot.size())),
        q(arrays(states.q, states.joints)),
        dq(arrays(states.dq, states.joints)),
        ddq(arrays(states.ddq, states.joints)),
        tau(arrays(states.tau, states.joints)) {}

  void copy(double* out) const { std::copy_n(result.data.data(), result.rows(), out); }

  KDL::Chain chain;  // the solvers keep a reference
  KDL::Vector gravity;
  KDL::ChainIdSolver_RNE id;
  KDL::ChainFdSolver_RNE fd;
  KDL::ChainDynParam dynamics;
  KDL::Wrenches no_wrenches;
  KDL::JntArray result;
  KDL::JntSpaceInertiaMatrix M;
  std::vector<KDL::JntArray> q, dq, ddq, tau;
};

}  // namespace

Peer make_kdl_peer(const test::NumericRobot& robot, const States& states) {
  const auto kdl = std::make_shared<Kdl>(robot, states);
  Peer peer;
  peer["id"] = [kdl](std::size_t k, double* tau) {
    kdl->id.CartToJnt(kdl->q[k], kdl->dq[k], kdl->ddq[k], kdl->no_wrenches, kdl->result);
    kdl->copy(tau);
  };
  peer["gravity"] = [kdl](std::size_t k, double* tau) {
    kdl->dynamics.JntToGravity(kdl->q[k], kdl->result);
    kdl->copy(tau);
  };
  peer["mass_matrix"] = [kdl](std::size_t k, double* M) {
    kdl->dynamics.JntToMass(kdl->q[k], kdl->M);
    std::copy_n(kdl->M.data.data(), kdl->M.data.size(), M);  // symmetric
  };
  peer["fd"] = [kdl](std::size_t k, double* ddq) {
    kdl->fd.CartToJnt(kdl->q[k], kdl->dq[k], kdl->tau[k], kdl->no_wrenches, kdl->result);
    kdl->copy(ddq);
  };
  return peer;
}

}  // namespace dyngen::bench
