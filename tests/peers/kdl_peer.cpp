// SPDX-License-Identifier: MIT
// Orocos KDL: chains and trees of segments; Newton-Euler and composite inertias by itself.
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl/treejnttojacsolver.hpp>
#include <memory>
#include <stdexcept>

#include "tests/peers/link_frames.h"
#include "tests/peers/peer.h"

namespace dyngen::test {
namespace {

KDL::Vector kdl_vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

KDL::Frame kdl_frame(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          kdl_vector(T.translation())};
}

KDL::JntArray kdl_array(const std::vector<double>& values) {
  KDL::JntArray result(static_cast<unsigned>(values.size()));
  for (unsigned i = 0; i < values.size(); ++i) result(i) = values[i];
  return result;
}

std::vector<double> list(const KDL::JntArray& values) {
  std::vector<double> result;
  for (unsigned i = 0; i < values.rows(); ++i) result.push_back(values(i));
  return result;
}

std::vector<double> list(const KDL::Frame& T) {
  std::vector<double> result;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) result.push_back(T.M(i, k));
    result.push_back(T.p(i));
  }
  result.insert(result.end(), {0, 0, 0, 1});
  return result;
}

std::vector<double> list(const KDL::Jacobian& J) {
  std::vector<double> result;
  for (unsigned i = 0; i < J.rows(); ++i) {
    for (unsigned k = 0; k < J.columns(); ++k) result.push_back(J(i, k));
  }
  return result;
}

void check(int status) {
  if (status < 0) throw std::runtime_error("KDL: error " + std::to_string(status));
}

KDL::RigidBodyInertia inertia(const NumericJoint& joint) {
  const CentralInertia link = central_inertia(joint);
  return KDL::RigidBodyInertia(
      link.mass, KDL::Vector(link.com[0], link.com[1], link.com[2]),
      KDL::RotationalInertia(link.xx, link.yy, link.zz, link.xy, link.xz, link.yz));
}

std::string link_name(std::size_t link) { return "link" + std::to_string(link); }

/// Every row of the robot's table makes two segments: a fixed one up to the axis, a moving one.
struct TwoSegments {
  KDL::Segment fixed, moving;
};

TwoSegments segments(const NumericRobot& robot, std::size_t j) {
  const NumericJoint& joint = robot.joints[j];
  const LinkFrames frames = link_frames(robot, j);
  const std::string name = link_name(j + 1);
  KDL::Joint motion(name + "_joint", KDL::Joint::None);
  if (joint.sigma != 2) {
    motion = KDL::Joint(name + "_joint", joint.sigma == 0 ? KDL::Joint::RotZ : KDL::Joint::TransZ,
                        1, 0, joint.IA);
  }
  return {KDL::Segment(name + "_axis", KDL::Joint(name + "_mount", KDL::Joint::None),
                       kdl_frame(frames.before)),
          KDL::Segment(name, motion, kdl_frame(frames.after), inertia(joint))};
}

KDL::Vector gravity_vector(const NumericRobot& robot) {
  const auto& a = robot.base_acceleration;
  return {-a[0], -a[1], -a[2]};
}

KDL::Wrench kdl_wrench(const std::array<double, 6>& w) {
  return {KDL::Vector(w[0], w[1], w[2]), KDL::Vector(w[3], w[4], w[5])};
}

struct Chain {
  explicit Chain(const NumericRobot& robot) : links(robot.size()) {
    for (std::size_t j = 0; j < robot.size(); ++j) {
      if (robot.joints[j].parent != static_cast<int>(j)) {
        throw std::invalid_argument("make_kdl_chain_peer(): the robot is a tree");
      }
      const TwoSegments two = segments(robot, j);
      chain.addSegment(two.fixed);
      chain.addSegment(two.moving);
    }
    joints = chain.getNrOfJoints();
    gravity = gravity_vector(robot);
  }

  [[nodiscard]] int segment(int link) const {
    return 2 * (link == 0 ? static_cast<int>(links) : link);
  }
  [[nodiscard]] KDL::Wrenches wrenches(const PeerInput& in) const {
    KDL::Wrenches result(chain.getNrOfSegments(), KDL::Wrench::Zero());
    result.back() = kdl_wrench(in.wrench);
    return result;
  }

  std::size_t links;
  KDL::Chain chain;  // the solvers keep a reference
  unsigned joints = 0;
  KDL::Vector gravity;
};

struct Tree {
  explicit Tree(const NumericRobot& robot)
      : tree(in_solver_order(robot)),
        gravity(gravity_vector(robot)),
        last(link_name(robot.size())) {
    for (const std::size_t j : moving_joints(robot)) {
      places.push_back(tree.getSegment(link_name(j + 1))->second.q_nr);
    }
  }

  /// A copy numbers the joints depth first, and some solvers work on a copy of the tree: a copy of
  /// a copy keeps its numbers.
  static KDL::Tree in_solver_order(const NumericRobot& robot) {
    KDL::Tree tree(link_name(0));
    for (std::size_t j = 0; j < robot.size(); ++j) {
      const TwoSegments two = segments(robot, j);
      const std::string parent = link_name(static_cast<std::size_t>(robot.joints[j].parent));
      if (!tree.addSegment(two.fixed, parent) ||
          !tree.addSegment(two.moving, two.fixed.getName())) {
        throw std::runtime_error("KDL: cannot add a segment");
      }
    }
    return KDL::Tree(tree);
  }

  [[nodiscard]] KDL::JntArray array(const std::vector<double>& values) const {
    KDL::JntArray result(tree.getNrOfJoints());
    for (std::size_t i = 0; i < values.size(); ++i) result(places[i]) = values[i];
    return result;
  }
  [[nodiscard]] std::vector<double> id(const KDL::Vector& g, const PeerInput& in) const {
    KDL::TreeIdSolver_RNE solver(tree, g);
    KDL::JntArray tau(tree.getNrOfJoints());
    check(solver.CartToJnt(array(in.q), array(in.dq), array(in.ddq),
                           {{last, kdl_wrench(in.wrench)}}, tau));
    std::vector<double> result;
    for (const unsigned place : places) result.push_back(tau(place));
    return result;
  }
  [[nodiscard]] std::string segment(int link) const {
    return link == 0 ? last : link_name(static_cast<std::size_t>(link));
  }

  KDL::Tree tree;
  KDL::Vector gravity;
  std::string last;
  std::vector<unsigned> places;  ///< of the robot's coordinates
};

std::vector<double> zeros(const PeerInput& in) { return std::vector<double>(in.q.size(), 0.0); }

}  // namespace

Peer make_kdl_chain_peer(const NumericRobot& robot) {
  const auto kdl = std::make_shared<Chain>(robot);
  Peer peer;
  peer.name = "KDL (chain)";
  peer.holds_rotor = true;
  peer.calls["id"] = [kdl](const PeerInput& in) {
    KDL::ChainIdSolver_RNE solver(kdl->chain, kdl->gravity);
    KDL::JntArray tau(kdl->joints);
    check(solver.CartToJnt(kdl_array(in.q), kdl_array(in.dq), kdl_array(in.ddq), kdl->wrenches(in),
                           tau));
    return list(tau);
  };
  peer.calls["gravity"] = [kdl](const PeerInput& in) {
    KDL::JntArray tau(kdl->joints);
    check(KDL::ChainDynParam(kdl->chain, kdl->gravity).JntToGravity(kdl_array(in.q), tau));
    return list(tau);
  };
  peer.calls["coriolis"] = [kdl](const PeerInput& in) {
    KDL::JntArray tau(kdl->joints);
    check(KDL::ChainDynParam(kdl->chain, kdl->gravity)
              .JntToCoriolis(kdl_array(in.q), kdl_array(in.dq), tau));
    return list(tau);
  };
  peer.calls["mass_matrix"] = [kdl](const PeerInput& in) {
    KDL::JntSpaceInertiaMatrix M(static_cast<int>(kdl->joints));
    check(KDL::ChainDynParam(kdl->chain, kdl->gravity).JntToMass(kdl_array(in.q), M));
    std::vector<double> result;
    for (unsigned i = 0; i < kdl->joints; ++i) {
      for (unsigned k = 0; k < kdl->joints; ++k) result.push_back(M(i, k));
    }
    return result;
  };
  peer.calls["fd"] = [kdl](const PeerInput& in) {
    KDL::ChainFdSolver_RNE solver(kdl->chain, kdl->gravity);
    KDL::JntArray ddq(kdl->joints);
    check(solver.CartToJnt(kdl_array(in.q), kdl_array(in.dq), kdl_array(in.tau), kdl->wrenches(in),
                           ddq));
    return list(ddq);
  };
  peer.calls["fk"] = [kdl](const PeerInput& in) {
    KDL::ChainFkSolverPos_recursive solver(kdl->chain);
    KDL::Frame T;
    check(solver.JntToCart(kdl_array(in.q), T, kdl->segment(in.link)));
    return list(T);
  };
  peer.calls["jacobian"] = [kdl](const PeerInput& in) {
    KDL::ChainJntToJacSolver solver(kdl->chain);
    KDL::Jacobian J(kdl->joints);
    check(solver.JntToJac(kdl_array(in.q), J, kdl->segment(in.link)));
    return list(J);
  };
  return peer;
}

Peer make_kdl_tree_peer(const NumericRobot& robot) {
  const auto kdl = std::make_shared<Tree>(robot);
  Peer peer;
  peer.name = "KDL (tree)";
  peer.holds_rotor = true;
  peer.calls["id"] = [kdl](const PeerInput& in) { return kdl->id(kdl->gravity, in); };
  peer.calls["gravity"] = [kdl](const PeerInput& in) {
    return kdl->id(kdl->gravity, {in.q, zeros(in), zeros(in), {}, {}, 0});
  };
  peer.calls["coriolis"] = [kdl](const PeerInput& in) {
    return kdl->id(KDL::Vector::Zero(), {in.q, in.dq, zeros(in), {}, {}, 0});
  };
  peer.calls["fk"] = [kdl](const PeerInput& in) {
    KDL::TreeFkSolverPos_recursive solver(kdl->tree);
    KDL::Frame T;
    check(solver.JntToCart(kdl->array(in.q), T, kdl->segment(in.link)));
    return list(T);
  };
  peer.calls["jacobian"] = [kdl](const PeerInput& in) {
    KDL::TreeJntToJacSolver solver(kdl->tree);
    KDL::Jacobian J(kdl->tree.getNrOfJoints());
    check(solver.JntToJac(kdl->array(in.q), J, kdl->segment(in.link)));
    std::vector<double> result;
    for (unsigned row = 0; row < 6; ++row) {
      for (const unsigned place : kdl->places) result.push_back(J(row, place));
    }
    return result;
  };
  return peer;
}

}  // namespace dyngen::test
