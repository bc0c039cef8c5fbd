// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/bench/speed_robots.h"
#include "tests/bench/speed_states.h"

namespace dyngen::bench {

/// A robot with its states, who computes what of it, and room for what batches read and write.
class Contest {
 public:
  explicit Contest(SpeedRobot robot);
  Contest(const Contest&) = delete;
  Contest& operator=(const Contest&) = delete;

  [[nodiscard]] const std::string& name() const { return robot_.name; }
  /// Of functions of one sample: by function and who ("-O2", "native", "KDL").
  [[nodiscard]] const std::map<std::string, std::map<std::string, StateCall>>& calls() const {
    return calls_;
  }
  /// Of all samples at once, likewise.
  [[nodiscard]] const std::map<std::string, std::map<std::string, std::function<void()>>>& sweeps()
      const {
    return sweeps_;
  }
  /// Enough for the largest output of one sample.
  [[nodiscard]] std::size_t output_size() const;

  /// Prints by how much results differ. @return false if something differs by more than it may
  bool verify();

 private:
  void add_emitted(const std::string& who, const Emitted& code);
  void add_sin_cos();
  bool agree(const std::string& what, const std::vector<double>& actual,
             const std::vector<double>& expected, double limit) const;
  /// Outputs of all states, one after the other.
  [[nodiscard]] std::vector<double> outputs(const StateCall& call, std::size_t size) const;
  [[nodiscard]] std::vector<double> stored_torques() const;
  [[nodiscard]] std::vector<double> difference_quotients() const;
  bool verify_torques();
  bool verify_matrices();
  bool verify_batches();

  SpeedRobot robot_;
  States states_;
  std::vector<double> q_, dq_, ddq_, tau_;  // joint by joint
  std::vector<float> q_float_, dq_float_, ddq_float_, chi_float_, tau_float_;
  std::map<std::string, std::map<std::string, StateCall>> calls_;
  std::map<std::string, std::map<std::string, std::function<void()>>> sweeps_;
};

}  // namespace dyngen::bench
