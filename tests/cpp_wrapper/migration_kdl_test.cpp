// SPDX-License-Identifier: MIT
// docs/howto/cpp_wrapper.md, "From Orocos KDL": each row of the table, both sides, on the PUMA 560.
#include <gtest/gtest.h>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "arm.hpp"
#include "loaded_arm.hpp"
#include "tests/peers/link_frames.h"
#include "tests/support/model_bridge.h"

namespace {

using dyngen::test::NumericJoint;

constexpr double kKdlTolerance = 1e-12;

/// The table's rows as KDL has them: Rx(al) Tx(d), then a joint about z and Tz(r).
KDL::Chain puma560() {
  const dyngen::test::NumericRobot robot =
      dyngen::test::numeric_robot(dyngen::test::read_model("robots/puma560.robot"));
  KDL::Chain chain;
  for (const NumericJoint& joint : robot.joints) {
    const dyngen::test::CentralInertia link = dyngen::test::central_inertia(joint);
    const KDL::RigidBodyInertia inertia(
        link.mass, KDL::Vector(link.com[0], link.com[1], link.com[2]),
        KDL::RotationalInertia(link.xx, link.yy, link.zz, link.xy, link.xz, link.yz));
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::None),
                     KDL::Frame(KDL::Rotation::RotX(joint.alpha), KDL::Vector(joint.d, 0, 0))));
    chain.addSegment(KDL::Segment(
        KDL::Joint(KDL::Joint::RotZ, 1, 0, joint.IA),
        KDL::Frame(KDL::Rotation::RotZ(joint.theta), KDL::Vector(0, 0, joint.r)), inertia));
  }
  return chain;
}

class FromKdl : public testing::Test {
 protected:
  FromKdl() {
    q.data << 0.3, -0.7, 0.5, 1.1, -0.4, 0.9;
    dq.data << -1.2, 0.8, 0.4, -0.6, 1.5, 0.7;
    ddq.data << 2.0, -1.0, 0.5, 3.0, -2.0, 1.0;
  }

  const KDL::Chain chain = puma560();
  const KDL::Vector g{0, 0, -9.81};
  const KDL::Wrenches no_wrenches = KDL::Wrenches(chain.getNrOfSegments(), KDL::Wrench::Zero());
  KDL::JntArray q{6}, dq{6}, ddq{6}, tau{6};
};

TEST_F(FromKdl, InverseDynamics) {
  KDL::ChainIdSolver_RNE solver(chain, g);
  solver.CartToJnt(q, dq, ddq, no_wrenches, tau);

  EXPECT_TRUE(arm::id_rigid(q.data, dq.data, ddq.data).isApprox(tau.data, kKdlTolerance));
  EXPECT_TRUE(arm::id(q.data, dq.data, ddq.data)
                  .isApprox(tau.data + arm::friction(dq.data), kKdlTolerance));
}

TEST_F(FromKdl, InverseDynamicsWithAWrenchAndGravityOfTheCaller) {
  KDL::Wrenches wrenches = no_wrenches;
  wrenches.back() = KDL::Wrench(KDL::Vector(10, -20, 30), KDL::Vector(1, 2, -3));
  const KDL::Vector tilted(1, 2, -9);
  KDL::ChainIdSolver_RNE solver(chain, tilted);
  solver.CartToJnt(q, dq, ddq, wrenches, tau);

  const loaded_arm::Matrix<3> gravity(-1, -2, 9);  // -g
  loaded_arm::Matrix<6> wrench;
  wrench << 10, -20, 30, 1, 2, -3;
  const loaded_arm::Matrix<10> no_payload = loaded_arm::Matrix<10>::Zero();
  EXPECT_TRUE(loaded_arm::id_rigid(q.data, dq.data, ddq.data, gravity, wrench, no_payload,
                                   loaded_arm::chi_values())
                  .isApprox(tau.data, kKdlTolerance));
}

TEST_F(FromKdl, MassMatrix) {
  KDL::ChainDynParam dynamics(chain, g);
  KDL::JntSpaceInertiaMatrix M(6);
  dynamics.JntToMass(q, M);

  EXPECT_TRUE(arm::mass_matrix(q.data).isApprox(M.data, kKdlTolerance));
}

TEST_F(FromKdl, Gravity) {
  KDL::ChainDynParam dynamics(chain, g);
  dynamics.JntToGravity(q, tau);

  EXPECT_TRUE(arm::gravity(q.data).isApprox(tau.data, kKdlTolerance));
}

TEST_F(FromKdl, Coriolis) {
  KDL::ChainDynParam dynamics(chain, g);
  dynamics.JntToCoriolis(q, dq, tau);

  EXPECT_TRUE(arm::coriolis(q.data, dq.data).isApprox(tau.data, kKdlTolerance));
}

TEST_F(FromKdl, ForwardKinematics) {
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::Frame last;
  solver.JntToCart(q, last);

  const auto matrix = [](const KDL::Frame& T) {
    Eigen::Isometry3d result;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) result.matrix()(i, k) = T(i, k);
    }
    return result;
  };
  EXPECT_TRUE(arm::fk(q.data).isApprox(matrix(last), kKdlTolerance));
}

TEST_F(FromKdl, Jacobian) {
  KDL::ChainJntToJacSolver solver(chain);
  KDL::Jacobian last(6);
  solver.JntToJac(q, last);

  EXPECT_TRUE(arm::jacobian(q.data).isApprox(last.data, kKdlTolerance));
}

}  // namespace
