// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_robot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "gen/model/chi.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kRow = kChiCount;

/// Keywords of the rows of a robot file, in the order of chi.h.
constexpr std::array<const char*, kChiCount> kRows = {"XX", "XY", "XZ", "YY", "YZ", "ZZ", "mX",
                                                      "mY", "mZ", "m",  "IA", "Fv", "Fs", "off"};

VectorXd values(std::initializer_list<double> list) {
  return Eigen::Map<const VectorXd>(std::data(list), static_cast<Index>(list.size()));
}

MotionLimits limits_of(const std::string& name, int joints) {
  if (name == "ur10e") {
    return {values({0, -1.4, 1.2, -1.0, 0.3, 0}), values({1.8, 1.0, 1.3, 1.6, 1.8, 2.2}),
            values({2, 2, 2.5, 3, 3, 3}), values({8, 8, 10, 14, 14, 14})};
  }
  return {VectorXd::Constant(joints, 0.3), VectorXd::Constant(joints, 1.2),
          VectorXd::Constant(joints, 2.5), VectorXd::Constant(joints, 12)};
}

/// A file that goes when its reader is done.
class BriefFile {
 public:
  explicit BriefFile(const std::string& text) {
    static int count = 0;
    path_ = (std::filesystem::temp_directory_path() /
             fmt::format("{}_case_{}.robot", getpid(), ++count))
                .string();
    std::ofstream(path_) << text;
  }
  ~BriefFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  BriefFile(const BriefFile&) = delete;
  BriefFile& operator=(const BriefFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The file with other numbers in its rows of parameters.
std::string with_parameters(const std::string& path, const VectorXd& standard) {
  std::ifstream input(path);
  if (!input) throw std::invalid_argument("case_robot(): cannot read " + path);
  std::string text;
  for (std::string line; std::getline(input, line);) {
    std::string word;
    std::istringstream(line) >> word;
    for (std::size_t k = 0; k < kRows.size(); ++k) {
      if (word != kRows[k]) continue;
      line = word;
      for (Index link = 0; link < standard.size() / kRow; ++link) {
        line += fmt::format(" {}", standard[kRow * link + static_cast<Index>(k)]);
      }
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace

double CaseRobot::actuator(int joint, Chi kind) const {
  return built.standard[kRow * joint + static_cast<Index>(index(kind))];
}

const std::vector<std::string>& case_robot_names() {
  static const std::vector<std::string> names = {"puma3", "ur10e", "planar2"};
  return names;
}

CaseRobot case_robot(const std::string& name, std::mt19937_64& random, double spread) {
  const auto& names = case_robot_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw std::invalid_argument(fmt::format("robot '{}': expected puma3, ur10e or planar2", name));
  }
  CaseRobot robot;
  robot.name = name;
  robot.told_path = fmt::format("{}/tests/studies/robots/{}.robot", DYNGEN_SOURCE_DIR, name);
  robot.told = runtime::describe_robot(robot.told_path, runtime::OpenParameters::kAsWritten);
  std::uniform_real_distribution<double> factor(1 - spread, 1 + spread);
  VectorXd standard = robot.told.standard;
  for (Index link = 0; link < standard.size() / kRow; ++link) {
    auto row = standard.segment(kRow * link, kRow);
    row.head(static_cast<Index>(kInertialCount)) *= factor(random);
    for (Index k = static_cast<Index>(kInertialCount); k < kRow; ++k) row[k] *= factor(random);
  }
  robot.built_text = with_parameters(robot.told_path, standard);
  const BriefFile file(robot.built_text);
  robot.built = runtime::describe_robot(file.path(), runtime::OpenParameters::kAsWritten);
  robot.beta = robot.built.grouping * robot.built.standard;
  robot.limits = limits_of(name, robot.joints());
  return robot;
}

runtime::SimulatedRobot built_plant(const CaseRobot& robot) {
  const BriefFile file(robot.built_text);
  return runtime::read_simulated_robot(file.path(), runtime::RobotUse::kPlant);
}

}  // namespace dyngen::test
