// SPDX-License-Identifier: MIT
// Habits of recording: how people move an arm, and with what they write it down.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/blind/simulation/motion.h"
#include "tests/blind/simulation/noise.h"

namespace blind {

/// The way of one motion.
enum class Path {
  kFourier,        ///< repeats
  kPoints,         ///< from posture to posture
  kTeaching,       ///< the same, slowly and with pauses
  kTeleoperation,  ///< irregular and smooth
  kChirps,
  kSpeedSteps,
  kSweeps,  ///< one joint after another
  kRamped,  ///< a Fourier series with rests and ramps before and after
};

struct Range {
  double low = 0, high = 0;

  bool empty() const { return high <= 0; }
};

/// Everything that a habit decides. Each seed draws a number of every range.
struct Habit {
  std::string name;
  Path path = Path::kFourier;
  int periods = 5;               ///< of one file
  int files = 3;                 ///< that are fitted
  Range length;                  ///< s of each; empty: the laboratory's, 18 to 26 s
  std::vector<double> rates;     ///< samples a second; empty: the laboratory's, 200, 250 or 400
  std::optional<Range> bits;     ///< of the encoders; nothing: the laboratory's, 16 to 20
  std::optional<Colour> colour;  ///< of the torque's noise; nothing: drawn
  Range jitter;                  ///< most of the time stamps' lateness, samples
  double stamp_digit = 0;        ///< s, to which time stamps are rounded
  Range late;                    ///< samples that positions are late
  double gain_error = 0;         ///< standard deviation of the torque's gain, of each joint
  Range disturbance;             ///< torque in the loop, deviation over the rms of the torque
  Range memory;                  ///< of that torque, s
  Range compensation_error;      ///< of the drive's own friction compensation; empty: it has none
  std::array<Path, 2> heldout = {Path::kFourier, Path::kPoints};
  /// Families that are right to be found of the habit alone.
  std::vector<std::string> allowed;
};

/// All habits; the first is "laboratory".
const std::vector<Habit>& habits();

/// @param name  empty: the laboratory
/// @throws std::invalid_argument  with the names that there are
const Habit& habit_of(const std::string& name);

/// One motion to draw.
struct Way {
  Path path = Path::kFourier;
  double length = 0;  ///< s, of one period of a Fourier series, or of all of another motion
  int periods = 1;    ///< within a ramped motion
  int harmonics = 5;  ///< of a Fourier series
};
Motion motion_along(const Way& way, const Arm& arm, Random random);

}  // namespace blind
