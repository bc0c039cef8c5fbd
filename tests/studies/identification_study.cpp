// SPDX-License-Identifier: MIT
// Identifies simulated robots whose truth is known and prints what came out as markdown.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/studies/claims.h"
#include "tests/studies/method_table.h"

namespace {

using namespace dyngen::test;

constexpr std::string_view kUsage =
    R"(usage: identification_study [options] [robot ...]

Robots: puma3 ur10e panda; none: all.
  --repetitions R   recordings of each robot (20)
  --first-seed S    of the first repetition (1); the others follow
  --no-repeat       motions that do not repeat, instead of two equal periods of 10 s
  --causes          what the misses of the 95 % intervals come from, instead of all methods
  --claims          what the thesis of 1995 says, measured, instead of all methods
)";

struct Options {
  std::vector<std::string> robots;
  StudyPlan plan;
  bool causes = false, claims = false;
};

int number(std::string_view text, std::string_view option) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) {
    throw std::invalid_argument(fmt::format("{}: '{}', expected a number above 0", option, text));
  }
  return value;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    const auto next = [&]() -> const std::string& {
      if (++i == arguments.size()) throw std::invalid_argument(word + ": expected a number");
      return arguments[i];
    };
    if (word == "--repetitions") {
      options.plan.repetitions = number(next(), word);
    } else if (word == "--first-seed") {
      options.plan.first_seed = static_cast<unsigned>(number(next(), word));
    } else if (word == "--no-repeat") {
      options.plan.motion.repeats = false;
    } else if (word == "--causes") {
      options.causes = true;
    } else if (word == "--claims") {
      options.claims = true;
    } else if (word.starts_with("-")) {
      throw std::invalid_argument("unknown option '" + word + "'");
    } else {
      options.robots.push_back(word);
    }
  }
  if (options.robots.empty()) options.robots = study_robot_names();
  return options;
}

void run(const Options& options) {
  for (const std::string& name : options.robots) {
    const StudyRobot robot = study_robot(name);
    if (options.claims) {
      print_claims(robot, options.plan);
    } else if (options.causes) {
      print_causes(robot, options.plan);
    } else {
      print_methods(robot, options.plan);
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    options = parse({argv + 1, argv + argc});
    for (const std::string& name : options.robots) {
      const auto& known = study_robot_names();
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw std::invalid_argument("unknown robot '" + name + "'");
      }
    }
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "identification_study: {}\n\n{}", error.what(), kUsage);
    return 2;
  }
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "identification_study: {}\n", error.what());
    return 1;
  }
}
