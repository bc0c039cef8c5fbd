// SPDX-License-Identifier: MIT
// make_fleet ROBOT FOLDER COUNT SECONDS RATE: recordings FOLDER/0.csv, 1.csv, ... and
// FOLDER/list.txt
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/fleet/fleet_recordings.h"

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  using dyngen::runtime::DescribedRobot;
  const DescribedRobot robot =
      dyngen::runtime::describe_robot(argv[1], dyngen::runtime::OpenParameters::kAbsentRows);
  const std::string folder = argv[2];
  std::filesystem::create_directories(folder);
  std::ofstream list(folder + "/list.txt");
  dyngen::test::FleetMotion motion;
  motion.seconds = std::atof(argv[4]);
  motion.rate = std::atof(argv[5]);
  for (int i = 0; i < std::atoi(argv[3]); ++i) {
    const std::string path = fmt::format("{}/{}.csv", folder, i);
    dyngen::runtime::write_recording(
        dyngen::test::fleet_recording(robot.linear, static_cast<unsigned>(i) + 1, motion), path);
    list << path << "\n";
  }
  return 0;
}
