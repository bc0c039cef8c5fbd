// SPDX-License-Identifier: MIT
// The same URDF and MJCF read by dyngen and by other engines: torques of random states.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "gen/symbols/exact.h"
#include "tests/gen/robot_input/description_text.h"
#include "tests/peers/made_mjcf.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

#ifdef DYNGEN_PEER_KDL_PARSER
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl_parser/kdl_parser.hpp>
#endif
#ifdef DYNGEN_PEER_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace dyngen::test {
namespace {

constexpr unsigned kRobots = 100;
constexpr double kTolerance = 1e-9;  // of the largest torque
constexpr int kSamples = 3;

/// Values by the names of joints.
using ByJoint = std::map<std::string, double>;

/// Torque without dry friction of the robot that dyngen reads, springs included.
class OwnRobot {
 public:
  OwnRobot(const std::string& text, const std::string& name)
      : file_(parse_robot(text, name)), model_(build_model(file_)), robot_(numeric_robot(model_)) {
    for (NumericJoint& joint : robot_.joints) joint.Fs = 0;
  }

  [[nodiscard]] std::vector<std::string> joints() const {
    std::vector<std::string> names;
    for (const JointModel& joint : model_.joints) {
      if (joint.coordinate >= 0) names.push_back(joint.name);
    }
    return names;
  }

  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq, const ByJoint& ddq) const {
    const std::vector<double> all = id<double>(robot_, values(q), values(dq), values(ddq));
    ByJoint result;
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (model_.joints[j].coordinate >= 0) result[model_.joints[j].name] = all[j];
    }
    for (const EffectRow& effect : file_.effects) {
      std::map<std::string, double> settings;
      for (const EffectRow::Setting& own : effect.settings) {
        settings[own.key] = to_double(own.value.value);
      }
      const std::string& joint =
          model_.joints[static_cast<std::size_t>(settings.at("joint")) - 1].name;
      result[joint] += settings.at("k") * q.at(joint) + settings.at("c");
    }
    return result;
  }

 private:
  [[nodiscard]] std::vector<double> values(const ByJoint& own) const {
    std::vector<double> result;
    for (const JointModel& joint : model_.joints) {
      result.push_back(joint.coordinate < 0 ? 0 : own.at(joint.name));
    }
    return result;
  }

  RobotFile file_;
  RobotModel model_;
  NumericRobot robot_;
};

ByJoint random_state(std::mt19937& random, const std::vector<std::string>& joints, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  ByJoint result;
  for (const std::string& joint : joints) result[joint] = uniform(random);
  return result;
}

/// @param peer  the torque of a state in another engine
template <class Peer>
void expect_same_torques(const OwnRobot& own, const Peer& peer, const std::string& what) {
  std::mt19937 random(5);
  for (int sample = 0; sample < kSamples; ++sample) {
    const ByJoint q = random_state(random, own.joints(), 2),
                  dq = random_state(random, own.joints(), 2),
                  ddq = random_state(random, own.joints(), 3);
    const ByJoint found = own.torque(q, dq, ddq), expected = peer.torque(q, dq, ddq);
    double size = 0;
    for (const auto& [name, torque] : expected) size = std::max(size, std::fabs(torque));
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (const auto& [name, torque] : expected) {
      ASSERT_NEAR(found.at(name), torque, kTolerance * size) << what << ", " << name;
    }
  }
}

#ifdef DYNGEN_PEER_KDL_PARSER

/// KDL's tree by ROS's parser of URDF, which knows no friction.
class KdlRobot {
 public:
  KdlRobot(const std::string& text, const std::vector<MadeLink>& links) : links_(links) {
    KDL::Tree tree;
    if (!kdl_parser::treeFromString(text, tree)) throw std::runtime_error("kdl_parser");
    tree_ = KDL::Tree(tree);  // numbered as the solver's copy is
  }

  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq, const ByJoint& ddq) const {
    KDL::TreeIdSolver_RNE solver(tree_, KDL::Vector(0, 0, -9.81));
    KDL::JntArray tau(tree_.getNrOfJoints());
    if (solver.CartToJnt(array(q), array(dq), array(ddq), {}, tau) < 0) {
      throw std::runtime_error("KDL");
    }
    ByJoint result;
    for (const MadeLink& link : links_) {
      if (link.parent < 0 || link.type == 2) continue;
      result[link.joint] =
          tau(tree_.getSegment(link.name)->second.q_nr) + link.damping * dq.at(link.joint);
    }
    return result;
  }

 private:
  [[nodiscard]] KDL::JntArray array(const ByJoint& values) const {
    KDL::JntArray result(tree_.getNrOfJoints());
    for (const MadeLink& link : links_) {
      if (link.parent < 0 || link.type == 2) continue;
      result(tree_.getSegment(link.name)->second.q_nr) = values.at(link.joint);
    }
    return result;
  }

  const std::vector<MadeLink>& links_;
  KDL::Tree tree_;
};

TEST(Descriptions, KdlHasTheTorquesOfRandomUrdfs) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const std::string text = urdf_of(links);
    expect_same_torques(OwnRobot(text, "made.urdf"), KdlRobot(text, links),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, KdlHasTheTorquesOfUrdfsThatAreWritten) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile file =
        parse_robot_file(parse_robot(urdf_of(links), "made.urdf").text, "m.robot");
    const std::string text = urdf_text(file, build_model(file)).text;
    std::vector<MadeLink> written = links;
    for (MadeLink& link : written) link.name = link.joint + "_link";
    expect_same_torques(OwnRobot(urdf_of(links), "made.urdf"), KdlRobot(text, written),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

#endif

#ifdef DYNGEN_PEER_MUJOCO

/// MuJoCo's own reading of a text; joint limits and dry friction are off.
class MujocoRobot {
 public:
  MujocoRobot(const std::string& text, const std::string& name) {
    // mjVFS is too large for the stack
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    if (mj_makeEmptyFileVFS(files.get(), name.c_str(), static_cast<int>(text.size())) != 0) {
      throw std::runtime_error("MuJoCo: no room for the model's text");
    }
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 500> message{};
    model_.reset(mj_loadXML(name.c_str(), files.get(), message.data(), message.size()));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(fmt::format("MuJoCo: {}\n{}", message.data(), text));
    if (name.ends_with(".urdf")) model_->opt.gravity[2] = -9.81;
    model_->opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT;
    data_.reset(mj_makeData(model_.get()));
  }

  [[nodiscard]] ByJoint torque(const ByJoint& q, const ByJoint& dq, const ByJoint& ddq) const {
    for (int j = 0; j < model_->njnt; ++j) {
      const std::string name = mj_id2name(model_.get(), mjOBJ_JOINT, j);
      data_->qpos[model_->jnt_qposadr[j]] = q.at(name);
      data_->qvel[model_->jnt_dofadr[j]] = dq.at(name);
      data_->qacc[model_->jnt_dofadr[j]] = ddq.at(name);
    }
    mj_inverse(model_.get(), data_.get());
    ByJoint result;
    for (int j = 0; j < model_->njnt; ++j) {
      result[mj_id2name(model_.get(), mjOBJ_JOINT, j)] = data_->qfrc_inverse[model_->jnt_dofadr[j]];
    }
    return result;
  }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

TEST(Descriptions, MujocoHasTheTorquesOfRandomUrdfs) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::string text = urdf_of(made_robot(seed));
    expect_same_torques(OwnRobot(text, "made.urdf"), MujocoRobot(text, "made.urdf"),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, MujocoHasTheTorquesOfRandomMjcf) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::string text = made_mjcf(seed);
    expect_same_torques(OwnRobot(text, "made.xml"), MujocoRobot(text, "made.xml"),
                        fmt::format("seed {}\n{}", seed, text));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, MujocoHasTheTorquesOfMjcfThatIsWritten) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile file =
        parse_robot_file(parse_robot(urdf_of(links), "made.urdf").text, "m.robot");
    const std::string text = mjcf_text(file, build_model(file)).text;
    expect_same_torques(OwnRobot(urdf_of(links), "made.urdf"), MujocoRobot(text, "made.xml"),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

#endif

}  // namespace
}  // namespace dyngen::test
