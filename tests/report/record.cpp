// SPDX-License-Identifier: MIT
// A recording whose truth is known: record PLANT.robot EFFECTS SEED SECONDS OUT.csv
//
// A motion of all joints, 200 samples a second, with the torque of the plant and its effects, and
// white noise of 0.3 N m. No loop moves it, so that nothing sticks: what a diagnosis of it finds is
// what the plant has.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>

#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "tests/runtime/dynid/multisine.h"

int main(int argc, char** argv) {
  using namespace dyngen;
  using namespace dyngen::runtime;
  if (argc != 6) {
    std::cerr << "usage: record PLANT.robot EFFECTS SEED SECONDS OUT.csv\n";
    return 2;
  }
  try {
    EffectCatalogue catalogue;
    catalogue.add_folder(argv[2]);
    const DescribedRobot plant = describe_robot(argv[1], OpenParameters::kAsWritten);
    const auto seed = static_cast<std::uint64_t>(std::atoll(argv[3]));
    const double seconds = std::atof(argv[4]);
    Recording recording = test::multisine(
        plant.linear, plant.grouping * plant.standard,
        {.seconds = seconds, .sample_time = 0.005, .period = seconds, .size = 1.5, .seed = seed});
    recording.tau = recorded_torque(plant, effect_instances(plant.model, catalogue), recording);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 0.3);
    for (Eigen::Index k = 0; k < recording.tau.size(); ++k)
      recording.tau.data()[k] += noise(random);
    recording.dq.resize(0, 0);
    recording.ddq.resize(0, 0);
    write_recording(recording, argv[5]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
