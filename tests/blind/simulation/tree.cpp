// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/tree.h"

#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace blind {
namespace {

using Model = std::unique_ptr<mjModel, void (*)(mjModel*)>;

Eigen::VectorXd numbers(const mjModel& model, const std::string& name, const std::string& path) {
  const int id = mj_name2id(&model, mjOBJ_NUMERIC, name.c_str());
  if (id < 0) throw std::runtime_error(path + ": there is no numeric '" + name + "'");
  if (model.numeric_size[id] != model.njnt) {
    throw std::runtime_error(path + ": numeric '" + name + "' needs a number for each joint");
  }
  return Eigen::Map<const Eigen::VectorXd>(model.numeric_data + model.numeric_adr[id], model.njnt);
}

}  // namespace

Arm read_arm(const std::string& path) {
  std::array<char, 500> message{};
  const Model owner(mj_loadXML(path.c_str(), nullptr, message.data(), message.size()),
                    mj_deleteModel);
  if (!owner) throw std::runtime_error(path + ": " + message.data());
  const mjModel& model = *owner;
  Arm arm;
  arm.name = std::filesystem::path(path).stem().string();
  arm.tree.gravity = Eigen::Map<const Eigen::Vector3d>(model.opt.gravity);
  arm.q_min.resize(model.njnt);
  arm.q_max.resize(model.njnt);
  for (int body = 1; body < model.nbody; ++body) {
    const int joint = model.body_jntadr[body];
    if (model.body_jntnum[body] != 1 || joint != body - 1) {
      throw std::runtime_error(path + ": every body needs one joint");
    }
    Link link;
    link.name = mj_id2name(&model, mjOBJ_BODY, body);
    link.parent = model.body_parentid[body] - 1;
    link.position = Eigen::Map<const Eigen::Vector3d>(model.body_pos + 3 * body);
    const double* turn = model.body_quat + 4 * body;
    link.turn = Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]).normalized();
    link.axis = Eigen::Map<const Eigen::Vector3d>(model.jnt_axis + 3 * joint);
    arm.q_min[joint] = model.jnt_range[2 * joint];
    arm.q_max[joint] = model.jnt_range[2 * joint + 1];
    arm.tree.links.push_back(link);
  }
  arm.v_max = numbers(model, "v_max", path);
  arm.a_max = numbers(model, "a_max", path);
  arm.mass = numbers(model, "mass", path);
  arm.size = numbers(model, "size", path);
  arm.armature = numbers(model, "armature", path);
  arm.coulomb = numbers(model, "coulomb", path);
  arm.viscous = numbers(model, "viscous", path);
  return arm;
}

Inertia sum(const std::vector<Inertia>& parts) {
  Inertia all;
  for (const Inertia& part : parts) {
    all.mass += part.mass;
    all.com += part.mass * part.com;
  }
  if (all.mass > 0) all.com /= all.mass;
  for (const Inertia& part : parts) {
    const Eigen::Vector3d r = part.com - all.com;
    all.about_com += part.about_com + part.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() -
                                                   r * r.transpose());
  }
  return all;
}

}  // namespace blind
