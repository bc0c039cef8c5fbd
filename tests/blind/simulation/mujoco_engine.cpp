// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <memory>

#include "tests/blind/simulation/engine.h"
#include "tests/support/mujoco_text.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string body_text(const Tree& tree, int index) {
  const Link& link = tree.links[static_cast<std::size_t>(index)];
  std::string text = fmt::format(
      "<body name=\"b{}\" pos=\"{:.17g} {:.17g} {:.17g}\" quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\">"
      "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>"
      "<joint type=\"{}\" axis=\"{:.17g} {:.17g} {:.17g}\"/>",
      index, link.position.x(), link.position.y(), link.position.z(), link.turn.w(), link.turn.x(),
      link.turn.y(), link.turn.z(), link.slides ? "slide" : "hinge", link.axis.x(), link.axis.y(),
      link.axis.z());
  for (int child = index + 1; child < static_cast<int>(tree.links.size()); ++child) {
    if (tree.links[static_cast<std::size_t>(child)].parent == index) text += body_text(tree, child);
  }
  return text + "</body>";
}

mjModel* load(const Tree& tree) {
  std::string text = fmt::format(
      "<mujoco><compiler angle=\"radian\"/><option gravity=\"{:.17g} {:.17g} {:.17g}\"/>"
      "<worldbody>",
      tree.gravity.x(), tree.gravity.y(), tree.gravity.z());
  for (int i = 0; i < static_cast<int>(tree.links.size()); ++i) {
    if (tree.links[static_cast<std::size_t>(i)].parent < 0) text += body_text(tree, i);
  }
  text += "</worldbody></mujoco>";
  return dyngen::test::mujoco_model_of_text(text, "tree.xml").release();
}

/// MuJoCo's coordinates follow its bodies, depth first: where each link went.
class World {
 public:
  explicit World(const Tree& tree)
      : model_(load(tree)), data_(mj_makeData(model_)), joint_(tree.links.size()) {
    for (std::size_t i = 0; i < tree.links.size(); ++i) {
      body_.push_back(mj_name2id(model_, mjOBJ_BODY, fmt::format("b{}", i).c_str()));
      joint_[i] = model_->jnt_dofadr[model_->body_jntadr[body_[i]]];
      set_inertia(static_cast<int>(i), tree.links[i].inertia);
    }
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  void set_inertia(int link, const Inertia& inertia) {
    const int body = body_[static_cast<std::size_t>(link)];
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
    if (!inertia.about_com.isZero(0)) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia.about_com);
      Eigen::Matrix3d axes = principal.eigenvectors();
      if (axes.determinant() < 0) axes.col(0) *= -1;
      turn = Eigen::Quaterniond(axes);
      moments = principal.eigenvalues();
    }
    model_->body_mass[body] = inertia.mass;
    Eigen::Map<Eigen::Vector3d>(model_->body_ipos + 3 * body) = inertia.com;
    Eigen::Map<Eigen::Vector3d>(model_->body_inertia + 3 * body) = moments;
    double* const q = model_->body_iquat + 4 * body;
    q[0] = turn.w(), q[1] = turn.x(), q[2] = turn.y(), q[3] = turn.z();
    model_->body_sameframe[body] = 0;
    placed_ = false;
  }

  void positions(const VectorXd& q) {
    if (placed_ && q == at_) return;
    for (std::size_t i = 0; i < joint_.size(); ++i) {
      data_->qpos[joint_[i]] = q[static_cast<Index>(i)];
    }
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    at_ = q;
    placed_ = true;
  }
  void velocities(const VectorXd& dq) {
    for (std::size_t i = 0; i < joint_.size(); ++i) {
      data_->qvel[joint_[i]] = dq[static_cast<Index>(i)];
    }
    mj_comVel(model_, data_);
  }

  void dynamics(const VectorXd& q, const VectorXd& dq, Dynamics& result) {
    positions(q);
    velocities(dq);
    mj_crb(model_, data_);
    const int n = model_->nv;
    full_.resize(n, n);
    force_.resize(n);
    mj_fullM(model_, full_.data(), data_->qM);
    mj_rne(model_, data_, 0, force_.data());
    result.M.resize(n, n);
    result.bias.resize(n);
    for (Index i = 0; i < n; ++i) {
      result.bias[i] = force_[at(i)];
      for (Index k = 0; k < n; ++k) result.M(i, k) = full_(at(i), at(k));
    }
  }

  VectorXd inverse(const VectorXd& q, const VectorXd& dq, const VectorXd& ddq) {
    positions(q);
    velocities(dq);
    force_.resize(model_->nv);
    for (Index i = 0; i < ddq.size(); ++i) data_->qacc[at(i)] = ddq[i];
    mj_rne(model_, data_, 1, force_.data());
    VectorXd result(ddq.size());
    for (Index i = 0; i < result.size(); ++i) result[i] = force_[at(i)];
    return result;
  }

  /// Torque of bodies, one after the other alone on each link, (n x points links).
  Eigen::MatrixXd alone(const VectorXd& q, const VectorXd& dq, const VectorXd& ddq,
                        const std::vector<Inertia>& points) {
    positions(q);  // placed once: inertias move no frame but their own
    Eigen::MatrixXd columns(ddq.size(), static_cast<Index>(points.size() * body_.size()));
    for (Index i = 0; i < ddq.size(); ++i) data_->qacc[at(i)] = ddq[i];
    force_.resize(model_->nv);
    Index column = 0;
    for (std::size_t link = 0; link < body_.size(); ++link) {
      const int body = body_[link];
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(data_->xmat +
                                                                                9 * body);
      const Eigen::Vector3d origin = Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body);
      for (const Inertia& point : points) {
        set_inertia(static_cast<int>(link), point);
        Eigen::Map<Eigen::Vector3d>(data_->xipos + 3 * body) = origin + turn * point.com;
        mj_comPos(model_, data_);
        velocities(dq);
        mj_rne(model_, data_, 1, force_.data());
        for (Index i = 0; i < ddq.size(); ++i) columns(i, column) = force_[at(i)];
        ++column;
      }
      set_inertia(static_cast<int>(link), {});
    }
    return columns;
  }

  Eigen::Vector3d place(const VectorXd& q, int link, const Eigen::Vector3d& point) {
    positions(q);
    const int body = body_[static_cast<std::size_t>(link)];
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(data_->xmat +
                                                                              9 * body);
    return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body) + turn * point;
  }

  Eigen::MatrixXd jacobian(const VectorXd& q, int link, const Eigen::Vector3d& point) {
    const Eigen::Vector3d where = place(q, link, point);
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> all(3, model_->nv);
    mj_jac(model_, data_, all.data(), nullptr, where.data(), body_[static_cast<std::size_t>(link)]);
    Eigen::MatrixXd result(3, model_->nv);
    for (Index i = 0; i < result.cols(); ++i) result.col(i) = all.col(at(i));
    return result;
  }

 private:
  Index at(Index coordinate) const { return joint_[static_cast<std::size_t>(coordinate)]; }

  mjModel* model_;
  mjData* data_;
  std::vector<int> body_, joint_;
  VectorXd at_;          // where the bodies are placed,
  bool placed_ = false;  // with the inertias that they have
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full_;
  VectorXd force_;
};

}  // namespace

std::function<Eigen::MatrixXd(const VectorXd&, const VectorXd&, const VectorXd&)> torque_of_each(
    const Tree& tree, const std::vector<Inertia>& points) {
  Tree empty = tree;
  for (Link& link : empty.links) link.inertia = {};
  return [world = std::make_shared<World>(empty), points](const VectorXd& q, const VectorXd& dq,
                                                          const VectorXd& ddq) {
    return world->alone(q, dq, ddq, points);
  };
}

Engine mujoco_engine(const Tree& tree) {
  const auto world = std::make_shared<World>(tree);
  Engine engine;
  engine.name = "MuJoCo";
  engine.dynamics = [world](const VectorXd& q, const VectorXd& dq, Dynamics& result) {
    world->dynamics(q, dq, result);
  };
  engine.inverse = [world](const VectorXd& q, const VectorXd& dq, const VectorXd& ddq) {
    return world->inverse(q, dq, ddq);
  };
  engine.jacobian = [world](const VectorXd& q, int link, const Eigen::Vector3d& point) {
    return world->jacobian(q, link, point);
  };
  engine.place = [world](const VectorXd& q, int link, const Eigen::Vector3d& point) {
    return world->place(q, link, point);
  };
  engine.set_inertia = [world](int link, const Inertia& inertia) {
    world->set_inertia(link, inertia);
  };
  return engine;
}

}  // namespace blind
