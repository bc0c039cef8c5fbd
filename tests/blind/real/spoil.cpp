// SPDX-License-Identifier: MIT
// blind_spoil: adds the torque of one more thing to the recordings of a real robot, or of nothing,
// and writes them as a case; apart from them what was added.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/blind/real/added_torque.h"
#include "tests/blind/real/shown.h"

namespace blind {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRounds = 12;     // of the search for a size
constexpr double kNear = 1.02;  // of the wanted strength, either way

struct Order {
  std::string robot, family;
  double strength = 300;
  std::uint64_t seed = 0;
  int joint = 0;  // 0: drawn
  fs::path data, project, out, sealed;
};

/// A name that says nothing.
std::string case_name(std::uint64_t seed) {
  Random random(seed ^ 0x4EA1ULL);
  std::string name;
  for (int i = 0; i < 12; ++i) name += "0123456789abcdef"[random.below(16)];
  return name;
}

std::vector<JointUse> uses_of(const std::vector<RealMotion>& fitted, const VectorXd& dry) {
  std::vector<JointUse> uses;
  for (Index j = 0; j < dry.size(); ++j) {
    JointUse use;
    use.low = use.high = fitted.front().q(0, j);
    use.dry = dry[j];
    std::vector<double> speeds;
    for (const RealMotion& motion : fitted) {
      use.low = std::min(use.low, motion.q.col(j).minCoeff());
      use.high = std::max(use.high, motion.q.col(j).maxCoeff());
      use.largest = std::max(use.largest, motion.tau.col(j).cwiseAbs().maxCoeff());
      for (const double v : motion.dq.col(j)) speeds.push_back(std::abs(v));
    }
    std::sort(speeds.begin(), speeds.end());
    use.fast = speeds[speeds.size() * 9 / 10];
    uses.push_back(use);
  }
  return uses;
}

/// Recordings as they are, and their motions.
struct Files {
  std::vector<Table> tables;
  std::vector<RealMotion> motions;
};

Files read(const std::vector<std::string>& names, const fs::path& data, double reach) {
  Files files;
  for (const std::string& name : names) {
    files.tables.push_back(Table::read((data / name).string()));
    files.motions.push_back(motion_of(files.tables.back(), reach));
  }
  return files;
}

/// Adds a torque of the wanted strength to all tables. @return what was added
nlohmann::json spoil(const Order& order, const RealRobot& robot, Files& fitted, Files& held) {
  const Shown shown(robot, fitted.motions);
  Random random(order.seed);
  const Index joints = fitted.motions.front().joints();
  const Index drawn = static_cast<Index>(random.below(static_cast<std::size_t>(joints)));
  const double duration = fitted.motions.front().t[fitted.motions.front().samples() - 1];
  const AddedTorque added = draw_torque(order.family, robot, uses_of(fitted.motions, shown.dry()),
                                        order.joint > 0 ? order.joint - 1 : drawn,
                                        fitted.motions.size(), duration, random);
  std::vector<Ground> grounds;
  for (const Files* files : {&fitted, &held}) {
    for (const RealMotion& motion : files->motions) {
      grounds.push_back({motion, shown.load(motion), grounds.size()});
    }
  }
  const auto torques = [&](double size) {
    std::vector<MatrixXd> all;
    for (std::size_t r = 0; r < fitted.motions.size(); ++r) {
      all.push_back(added.torque(size, grounds[r]));
    }
    return all;
  };
  double size = added.typical, strength = 0;
  for (int round = 0; round < kRounds; ++round) {
    strength = shown.squares(torques(size));
    if (strength < order.strength * kNear && strength > order.strength / kNear) break;
    size *= std::sqrt(order.strength / std::max(strength, 1e-12));
  }
  std::size_t recording = 0;
  for (Files* files : {&fitted, &held}) {
    for (std::size_t r = 0; r < files->tables.size(); ++r, ++recording) {
      const MatrixXd tau = files->motions[r].tau + added.torque(size, grounds[recording]);
      files->tables[r].set_by_joint("tau", tau);
    }
  }
  return {{"family", added.family},
          {"form", added.form},
          {"joint", added.joint},
          {"other_joint", added.other},
          {"size", size},
          {"strength", strength},
          {"numbers", added.numbers},
          {"absorbed", shown.absorbed(torques(size))}};
}

void make(const Order& order) {
  const RealRobot robot = real_robot(order.robot);
  Files fitted = read(robot.train, order.data, robot.reach);
  Files held = read(robot.held, order.data, robot.reach);
  nlohmann::json entry = {{"case", case_name(order.seed)},
                          {"recording", order.robot},
                          {"seed", order.seed},
                          {"added", nullptr}};
  if (order.family != "none") entry["added"] = spoil(order, robot, fitted, held);
  const std::string name = entry["case"];
  fs::create_directories(order.out / name);
  fs::create_directories(order.sealed);
  fs::permissions(order.sealed, fs::perms::owner_all);
  for (std::size_t r = 0; r < fitted.tables.size(); ++r) {
    fitted.tables[r].write((order.out / name / fmt::format("train{}.csv", r + 1)).string());
  }
  for (std::size_t r = 0; r < held.tables.size(); ++r) {
    held.tables[r].write((order.out / name / fmt::format("held{}.csv", r + 1)).string());
  }
  fs::copy_file(order.project / robot.robot_file, order.out / name / "robot.robot",
                fs::copy_options::overwrite_existing);
  std::ofstream(order.sealed / (name + ".json")) << entry.dump(1) << '\n';
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Adds one more thing's torque to real recordings."};
  blind::Order order;
  app.add_option("--recording", order.robot, "tx40 dfki")->required();
  app.add_option("--family", order.family, "what acts besides; none: nothing")->required();
  app.add_option("--strength", order.strength, "squares that a refit leaves of it")
      ->check(CLI::PositiveNumber);
  app.add_option("--joint", order.joint, "from 1; else drawn");
  app.add_option("--seed", order.seed, "of its numbers and of the case's name")->required();
  app.add_option("--data", order.data, "folder of the real recordings")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--project", order.project, "the project's folder: robot files")->required();
  app.add_option("--out", order.out, "folder of the case folders")->required();
  app.add_option("--sealed", order.sealed, "folder of the manifest's entries")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    blind::make(order);
  } catch (const std::exception& error) {
    fmt::print(stderr, "blind_spoil: {}\n", error.what());
    return 1;
  }
  return 0;
}
