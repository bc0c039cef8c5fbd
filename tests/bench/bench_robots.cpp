// SPDX-License-Identifier: MIT
#include "tests/bench/bench_robots.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen::bench {

std::vector<std::filesystem::path> project_robots() {
  std::vector<std::filesystem::path> paths;
  const std::filesystem::path folder = std::filesystem::path(DYNGEN_SOURCE_DIR) / "robots";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".robot") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

namespace {

bool is_zero(Chi kind, Unknown unknown) {
  const bool symmetric = unknown == Unknown::kSymmetric;
  if (kind == Chi::kMX || kind == Chi::kMY) return symmetric;
  const bool product = kind == Chi::kXY || kind == Chi::kXZ || kind == Chi::kYZ;
  return product && (symmetric || unknown == Unknown::kDiagonal);
}

}  // namespace

RobotModel with_unknown_parameters(RobotModel model, Unknown unknown) {
  for (JointModel& joint : model.joints) {
    const bool drive = unknown == Unknown::kInertialAndDrive && joint.type != JointType::kFixed;
    for (std::size_t k = 0; k < kChiCount; ++k) {
      Quantity& quantity = joint.chi[k];
      const int line = quantity.line;
      quantity = Quantity{};
      quantity.line = line;
      const bool inertial = k < kInertialCount && !is_zero(static_cast<Chi>(k), unknown);
      quantity.unknown = inertial || (drive && k >= kInertialCount && k != index(Chi::kOFF));
    }
  }
  return model;
}

std::string generic_chain(int joints) {
  std::string text = fmt::format("name chain{}\nnumber_link {}\n", joints, joints);
  std::string alpha = "al", d = "d", r = "r", unknown;
  for (int j = 1; j <= joints; ++j) {
    alpha += j % 2 == 0 ? " pi/2" : " -pi/2";
    d += fmt::format(" 0.{}", 10 + j);
    r += fmt::format(" 0.{}", 50 + j);
    unknown += " *";
  }
  text += alpha + "\n" + d + "\n" + r + "\n";
  for (const char* row :
       {"m", "mX", "mY", "mZ", "XX", "XY", "XZ", "YY", "YZ", "ZZ", "IA", "Fs", "Fv"}) {
    text += row + unknown + "\n";
  }
  return text + "gx 0\ngy 0\ngz 9.81\nstop\n";
}

}  // namespace dyngen::bench
