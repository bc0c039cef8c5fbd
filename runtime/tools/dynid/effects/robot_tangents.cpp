// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/robot_tangents.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gen/symbols/exact.h"
#include "gen/tangents/tangents.h"
#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<const char*, 6> kWrench = {"fx", "fy", "fz", "nx", "ny", "nz"};

std::span<const double> values(const MatrixXd& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

VectorXd values_of(const std::vector<ParameterSum>& sums, const VectorXd& standard) {
  VectorXd result = VectorXd::Zero(static_cast<Index>(sums.size()));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (const ParameterSum::Term& term : sums[i].terms) {
      result[static_cast<Index>(i)] += term.factor * standard[term.place];
    }
  }
  return result;
}

/// All outputs of a program over a motion, each element a column.
std::map<std::string, MatrixXd> run(const Program& program, const JointMotion& motion,
                                    const VectorXd& chi, const VectorXd& gravity) {
  const Index samples = motion.q.rows();
  std::map<std::string, MatrixXd> outputs;
  for (const Program::Result& result : program.results) {
    MatrixXd& array = outputs[result.array];
    if (array.cols() <= result.index) array.resize(samples, result.index + 1);
  }
  std::vector<OutputArray> places;
  for (auto& [name, array] : outputs) {
    places.push_back({name, {array.data(), static_cast<std::size_t>(array.size())}});
  }
  const MatrixXd c = chi, g = gravity;
  evaluate(program, static_cast<std::size_t>(samples),
           {{"q", values(motion.q)},
            {"dq", values(motion.dq)},
            {"ddq", values(motion.ddq)},
            {"chi", values(c)},
            {"gravity", values(g)}},
           places);
  return outputs;
}

/// One element of every row of a row-major array.
MatrixXd column_of(const MatrixXd& array, Index column, Index width, Index rows) {
  MatrixXd result(array.rows(), rows);
  for (Index i = 0; i < rows; ++i) result.col(i) = array.col(i * width + column);
  return result;
}

/// The programs of a robot, written when they are needed.
class Tangents {
 public:
  explicit Tangents(const DescribedRobot& robot) : model_(robot.model), robot_(robot) {
    gravity_.resize(3);
    for (Index k = 0; k < 3; ++k) {
      gravity_[k] = to_double(model_.gravity[static_cast<std::size_t>(k)].value);
    }
  }

  MatrixXd operator()(const std::string& name, int link, const JointMotion& motion,
                      const VectorXd& beta) {
    const Index n = model_.coordinate_count;
    const VectorXd standard = nearest_standard(robot_, beta);
    if (name == "d_gx" || name == "d_gy" || name == "d_gz") {
      VectorXd direction = VectorXd::Zero(3);
      direction[name[3] - 'x'] = 1;
      const TangentProgram& program = kept(gravity_torque_, [&] { return gravity_torque(model_); });
      return run(program.program, motion, values_of(program.chi, standard), direction).at("tau");
    }
    if (name == "d_q" || name == "d_qd" || name == "d_qdd") {
      const std::string array = name == "d_q" ? "D_q" : name == "d_qd" ? "D_dq" : "D_ddq";
      const TangentProgram& program =
          kept(derivatives_, [&] { return motion_derivatives(model_); });
      const auto outputs = run(program.program, motion, values_of(program.chi, standard), gravity_);
      return column_of(outputs.at(array), coordinate(link), n, n);
    }
    if (name.starts_with("payload_")) return payload(name.substr(8), motion);
    if (name.starts_with("contact_")) {
      const auto [place, added] = jacobians_.try_emplace(link);
      if (added) place->second = link_jacobian(model_, link);
      const MatrixXd J = run(place->second, motion, {}, gravity_).at("J");
      return J.middleCols(component(name.substr(8)) * n, n);
    }
    if (name.starts_with("wrench_")) {
      const TangentProgram& program = kept(wrenches_, [&] { return joint_wrenches(model_); });
      const MatrixXd w =
          run(program.program, motion, values_of(program.chi, standard), gravity_).at("w");
      return w.middleCols(component(name.substr(7)) * n, n);
    }
    return geometry(name, link, motion, standard);
  }

 private:
  template <typename Make>
  static const TangentProgram& kept(std::optional<TangentProgram>& program, const Make& make) {
    if (!program) program = make();
    return *program;
  }

  [[nodiscard]] Index coordinate(int link) const {
    const int place = link >= 1 && link <= model_.size() ? model_.joint(link).coordinate : -1;
    if (place < 0) throw std::invalid_argument("robot_tangents(): the link has no joint");
    return place;
  }

  static Index component(const std::string& name) {
    for (std::size_t k = 0; k < kWrench.size(); ++k) {
      if (name == kWrench[k]) return static_cast<Index>(k);
    }
    throw std::invalid_argument("robot_tangents(): there is no component '" + name + "'");
  }

  MatrixXd payload(const std::string& name, const JointMotion& motion) {
    if (!payload_) payload_ = payload_regressor(model_);
    const Index n = model_.coordinate_count;
    const auto width = static_cast<Index>(payload_->columns.size());
    const MatrixXd Y = run(payload_->program, motion, {}, gravity_).at("Y");
    MatrixXd result = MatrixXd::Zero(motion.q.rows(), n);
    bool known = false;
    for (std::size_t kind = 0; kind < kInertialCount; ++kind) {
      if (name != kChiNames[kind]) continue;
      known = true;
      for (Index c = 0; c < width; ++c) {
        for (const auto& term : payload_->columns[static_cast<std::size_t>(c)].terms) {
          if (term.place == static_cast<int>(kind))
            result += term.factor * column_of(Y, c, width, n);
        }
      }
    }
    if (!known) throw std::invalid_argument("robot_tangents(): there is no payload_" + name);
    return result;
  }

  MatrixXd geometry(const std::string& name, int link, const JointMotion& motion,
                    const VectorXd& standard) {
    static const std::map<std::string, DhConstant> kConstants = {{"d_alpha", DhConstant::kAlpha},
                                                                 {"d_d", DhConstant::kD},
                                                                 {"d_theta", DhConstant::kTheta},
                                                                 {"d_r", DhConstant::kR}};
    const auto constant = kConstants.find(name);
    if (constant == kConstants.end()) {
      throw std::invalid_argument("robot_tangents(): there is no '" + name + "'");
    }
    const auto [place, added] = geometry_.try_emplace({name, link});
    if (added) place->second = geometry_derivative(model_, link, constant->second);
    const Index n = model_.coordinate_count, samples = motion.q.rows();
    const auto with_one_more = [&](const MatrixXd& part) {
      MatrixXd result = MatrixXd::Zero(samples, n + 1);
      result.leftCols(n) = part;
      return result;
    };
    const TangentProgram& program = place->second;
    const JointMotion more{with_one_more(motion.q), with_one_more(motion.dq),
                           with_one_more(motion.ddq)};
    const auto outputs = run(program.program, more, values_of(program.chi, standard), gravity_);
    return column_of(outputs.at("D"), n, n + 1, n);
  }

  RobotModel model_;
  DescribedRobot robot_;
  VectorXd gravity_;
  std::optional<TangentProgram> gravity_torque_, derivatives_, wrenches_;
  std::optional<PayloadProgram> payload_;
  std::map<int, Program> jacobians_;
  std::map<std::pair<std::string, int>, TangentProgram> geometry_;
};

}  // namespace

TangentFunction robot_tangents(const DescribedRobot& robot) {
  auto tangents = std::make_shared<Tangents>(robot);
  auto guard = std::make_shared<std::mutex>();  // programs are written when they are needed
  return [tangents, guard](const std::string& name, int link, const JointMotion& motion,
                           const VectorXd& beta) {
    const std::lock_guard lock(*guard);
    return (*tangents)(name, link, motion, beta);
  };
}

EffectRobot effect_robot(const DescribedRobot& robot) {
  EffectRobot result;
  result.tangent = robot_tangents(robot);
  result.joined_rotors = VectorXd::Zero(robot.model.coordinate_count);
  for (const Index place : joined_rotors(robot)) {
    const int link = static_cast<int>(place / static_cast<Index>(kChiCount)) + 1;
    result.joined_rotors[robot.model.joint(link).coordinate] = robot.standard[place];
  }
  return result;
}

}  // namespace dyngen::runtime
