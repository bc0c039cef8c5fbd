// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/robot_tangents.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gen/model/chi.h"
#include "gen/symbols/exact.h"
#include "gen/tangents/tangents.h"
#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Derivatives by a joint's motion, and the arrays of motion_derivatives() that have them.
constexpr std::array<std::pair<const char*, const char*>, 3> kByMotion = {
    {{"d_q", "D_q"}, {"d_qd", "D_dq"}, {"d_qdd", "D_ddq"}}};
constexpr std::array<const char*, 6> kWrench = {"fx", "fy", "fz", "nx", "ny", "nz"};

std::span<const double> numbers_of(const MatrixXd& matrix) {
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
           {{"q", numbers_of(motion.q)},
            {"dq", numbers_of(motion.dq)},
            {"ddq", numbers_of(motion.ddq)},
            {"chi", numbers_of(c)},
            {"gravity", numbers_of(g)}},
           places);
  return outputs;
}

/// One element of every row of a row-major array.
MatrixXd column_of(const MatrixXd& array, Index column, Index width, Index rows) {
  MatrixXd result(array.rows(), rows);
  for (Index i = 0; i < rows; ++i) result.col(i) = array.col(i * width + column);
  return result;
}

/// Standard parameters of a robot that has nothing but a first moment, of 1 kg m, of the first link
/// that moves; without even that where a base parameter has it.
VectorXd hidden_moment(const DescribedRobot& robot) {
  VectorXd standard = VectorXd::Zero(robot.grouping.cols());
  for (int link = 1; link <= robot.model.size(); ++link) {
    if (robot.model.joint(link).coordinate < 0) continue;
    const Index first = static_cast<Index>(kChiCount) * (link - 1);
    const Index x = first + static_cast<Index>(Chi::kMX), y = first + static_cast<Index>(Chi::kMY);
    if (robot.grouping.col(x).isZero(0) && robot.grouping.col(y).isZero(0)) standard[x] = 1;
    break;
  }
  return standard;
}

/// The programs of a robot, written when they are needed; any number of threads may ask.
class Tangents {
 public:
  explicit Tangents(const DescribedRobot& robot) : model_(robot.model), robot_(robot) {
    gravity_.resize(3);
    for (Index k = 0; k < 3; ++k) {
      gravity_[k] = to_double(model_.gravity[static_cast<std::size_t>(k)].value);
    }
  }

  TangentColumns operator()(const TangentKey& wanted, const JointMotion& motion,
                            const VectorXd& beta, double further) {
    const auto& [name, link] = wanted;
    TangentColumns result;
    if (name.starts_with("payload_")) {
      result = payload(link, motion);
    } else if (name.starts_with("contact_")) {
      result = contact(link, motion);
    } else {
      const VectorXd standard = nearest_standard(robot_, beta);
      if (name == "d_gx" || name == "d_gy" || name == "d_gz") {
        result = gravity(motion, standard);
      } else if (name == "hidden_gx" || name == "hidden_gy") {
        result = hidden_gravity(motion);
      } else if (name == "d_q" || name == "d_qd" || name == "d_qdd") {
        result = further == 0 ? by_motion(motion, standard)
                              : by_motion_of(link, further_of(link, motion, further), standard);
      } else if (name.starts_with("wrench_")) {
        result = wrench(motion, standard);
      } else {
        result = geometry(name, link, motion, standard, further);
      }
    }
    if (result.contains(wanted)) return result;
    throw std::invalid_argument(
        fmt::format("robot_tangents(): there is no '{}' of link {}", name, link));
  }

 private:
  /// Written once; stays where it is.
  template <typename Kept, typename Make>
  const Kept& kept(std::unique_ptr<Kept>& program, const Make& make) {
    const std::lock_guard lock(guard_);
    if (!program) program = std::make_unique<Kept>(make());
    return *program;
  }

  TangentColumns gravity(const JointMotion& motion, const VectorXd& standard) {
    const TangentProgram& program = kept(gravity_torque_, [&] { return gravity_torque(model_); });
    const VectorXd chi = values_of(program.chi, standard);
    TangentColumns result;
    for (Index axis = 0; axis < 3; ++axis) {
      const std::string name = std::string("d_g") + "xyz"[axis];
      result[{name, 0}] = run(program.program, motion, chi, VectorXd::Unit(3, axis)).at("tau");
    }
    return result;
  }

  /// Where the first axis stands along gravity no base parameter has the first moments of its link;
  /// a base that is not level makes them show.
  TangentColumns hidden_gravity(const JointMotion& motion) {
    const VectorXd moment = hidden_moment(robot_);
    const TangentColumns all = gravity(motion, moment);
    return {{{"hidden_gx", 0}, all.at({"d_gx", 0})}, {{"hidden_gy", 0}, all.at({"d_gy", 0})}};
  }

  [[nodiscard]] JointMotion further_of(int link, JointMotion motion, double further) const {
    if (further == 0 || link < 1 || link > model_.size()) return motion;
    const int coordinate = model_.joint(link).coordinate;
    if (coordinate >= 0) motion.q.col(coordinate).array() += further;
    return motion;
  }

  TangentColumns by_motion(const JointMotion& motion, const VectorXd& standard) {
    const Index n = model_.coordinate_count;
    const TangentProgram& program = kept(derivatives_, [&] { return motion_derivatives(model_); });
    const auto outputs = run(program.program, motion, values_of(program.chi, standard), gravity_);
    TangentColumns result;
    for (int link = 1; link <= model_.size(); ++link) {
      const int coordinate = model_.joint(link).coordinate;
      if (coordinate < 0) continue;
      for (const auto& [name, array] : kByMotion) {
        result[{name, link}] = column_of(outputs.at(array), coordinate, n, n);
      }
    }
    return result;
  }

  /// Those of one link: a search asks for them at every distance that it tries.
  TangentColumns by_motion_of(int link, const JointMotion& motion, const VectorXd& standard) {
    const Index n = model_.coordinate_count;
    const int coordinate = link < 1 || link > model_.size() ? -1 : model_.joint(link).coordinate;
    if (coordinate < 0) return {};
    const TangentProgram& all = kept(derivatives_, [&] { return motion_derivatives(model_); });
    std::unique_lock lock(guard_);
    std::unique_ptr<TangentProgram>& place = derivatives_of_[link];
    lock.unlock();
    const TangentProgram& program = kept(place, [&] {
      return TangentProgram{with_results(all.program,
                                         [&](const Program::Result& result) {
                                           return result.index % n == coordinate;
                                         }),
                            all.chi};
    });
    const auto outputs = run(program.program, motion, values_of(program.chi, standard), gravity_);
    TangentColumns result;
    for (const auto& [name, array] : kByMotion) {
      result[{name, link}] = column_of(outputs.at(array), coordinate, n, n);
    }
    return result;
  }

  TangentColumns payload(int link, const JointMotion& motion) {
    if (link < 0 || link > model_.size()) return {};
    std::unique_lock lock(guard_);
    std::unique_ptr<PayloadProgram>& place = payloads_[link];
    lock.unlock();
    const PayloadProgram& program = kept(
        place, [&] { return payload_regressor(model_, link == 0 ? model_.size() : link); });
    const Index n = model_.coordinate_count;
    const auto width = static_cast<Index>(program.columns.size());
    const MatrixXd Y = run(program.program, motion, {}, gravity_).at("Y");
    TangentColumns result;
    for (std::size_t kind = 0; kind < kInertialCount; ++kind) {
      MatrixXd& columns = result[TangentKey("payload_" + std::string(kChiNames[kind]), link)];
      columns = MatrixXd::Zero(motion.q.rows(), n);
      for (Index c = 0; c < width; ++c) {
        for (const auto& term : program.columns[static_cast<std::size_t>(c)].terms) {
          if (term.place == static_cast<int>(kind)) {
            columns += term.factor * column_of(Y, c, width, n);
          }
        }
      }
    }
    return result;
  }

  TangentColumns contact(int link, const JointMotion& motion) {
    std::unique_lock lock(guard_);
    std::unique_ptr<Program>& place = jacobians_[link];
    lock.unlock();
    const Program& program = kept(place, [&] { return link_jacobian(model_, link); });
    return parts_of(run(program, motion, {}, gravity_).at("J"), "contact_", link);
  }

  TangentColumns wrench(const JointMotion& motion, const VectorXd& standard) {
    const TangentProgram& program = kept(wrenches_, [&] { return joint_wrenches(model_); });
    const VectorXd chi = values_of(program.chi, standard);
    return parts_of(run(program.program, motion, chi, gravity_).at("w"), "wrench_", 0);
  }

  /// Forces and moments of an array that has the columns of all joints for each.
  [[nodiscard]] TangentColumns parts_of(const MatrixXd& array, const std::string& group,
                                        int link) const {
    const Index n = model_.coordinate_count;
    TangentColumns result;
    for (std::size_t k = 0; k < kWrench.size(); ++k) {
      result[{group + kWrench[k], link}] = array.middleCols(static_cast<Index>(k) * n, n);
    }
    return result;
  }

  TangentColumns geometry(const std::string& name, int link, const JointMotion& motion,
                          const VectorXd& standard, double further) {
    static const std::map<std::string, DhConstant> kConstants = {{"d_alpha", DhConstant::kAlpha},
                                                                 {"d_d", DhConstant::kD},
                                                                 {"d_theta", DhConstant::kTheta},
                                                                 {"d_r", DhConstant::kR}};
    const auto constant = kConstants.find(name);
    if (constant == kConstants.end()) return {};
    std::unique_lock lock(guard_);
    std::unique_ptr<TangentProgram>& place = geometry_[{name, link}];
    lock.unlock();
    const TangentProgram& program =
        kept(place, [&] { return geometry_derivative(model_, link, constant->second); });
    const Index n = model_.coordinate_count, samples = motion.q.rows();
    const auto with_one_more = [&](const MatrixXd& part, double value) {
      MatrixXd result = MatrixXd::Constant(samples, n + 1, value);
      result.leftCols(n) = part;
      return result;
    };
    const JointMotion more{with_one_more(motion.q, further), with_one_more(motion.dq, 0),
                           with_one_more(motion.ddq, 0)};
    const auto outputs = run(program.program, more, values_of(program.chi, standard), gravity_);
    return {{{name, link}, column_of(outputs.at("D"), n, n + 1, n)}};
  }

  RobotModel model_;
  DescribedRobot robot_;
  VectorXd gravity_;
  std::mutex guard_;  // of the programs
  std::unique_ptr<TangentProgram> gravity_torque_, derivatives_, wrenches_;
  std::map<int, std::unique_ptr<PayloadProgram>> payloads_;  // by link
  std::map<int, std::unique_ptr<TangentProgram>> derivatives_of_;  // by link
  std::map<int, std::unique_ptr<Program>> jacobians_;
  std::map<TangentKey, std::unique_ptr<TangentProgram>> geometry_;
};

}  // namespace

TangentFunction robot_tangents(const DescribedRobot& robot) {
  auto tangents = std::make_shared<Tangents>(robot);
  return [tangents](const TangentKey& wanted, const JointMotion& motion, const VectorXd& beta,
                    double further) { return (*tangents)(wanted, motion, beta, further); };
}

EffectRobot effect_robot(const DescribedRobot& robot) {
  EffectRobot result;
  result.tangents = robot_tangents(robot);
  result.joined_rotors = VectorXd::Zero(robot.model.coordinate_count);
  for (const Index place : joined_rotors(robot)) {
    const int link = static_cast<int>(place / static_cast<Index>(kChiCount)) + 1;
    result.joined_rotors[robot.model.joint(link).coordinate] = robot.standard[place];
  }
  return result;
}

std::vector<LoadPlace> load_places(const DescribedRobot& robot) {
  std::vector<LoadPlace> places;
  for (int link = 1; link < robot.model.size(); ++link) {
    const int coordinate = robot.model.joint(link).coordinate;
    if (coordinate >= 0) places.push_back({coordinate, link});
  }
  places.push_back({-1, 0});
  return places;
}

}  // namespace dyngen::runtime
