// SPDX-License-Identifier: MIT
#include "tests/bench/speed_contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/relative_error.h"

namespace dyngen::bench {
namespace {

// The peers' own rounding is far below it; MuJoCo normalises quaternions.
constexpr double kAgreement = 1e-6;
constexpr double kSingle = 1e-4;
/// Difference quotients of a step of 1e-5 lose half of the digits.
constexpr double kQuotients = 1e-5;
constexpr std::size_t kDifferentiated = 5;  // states

const char* const kPlain = "-O2";

std::vector<float> single(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

Contest::Contest(SpeedRobot robot)
    : robot_(std::move(robot)), states_(random_states(robot_.numbers.size())) {
  const std::size_t n = states_.joints;
  q_ = joint_major(states_.q, n);
  dq_ = joint_major(states_.dq, n);
  ddq_ = joint_major(states_.ddq, n);
  tau_.resize(kStates * n);
  q_float_ = single(q_);
  dq_float_ = single(dq_);
  ddq_float_ = single(ddq_);
  chi_float_ = single(robot_.chi);
  tau_float_.resize(kStates * n);
  add_emitted(kPlain, robot_.plain);
  add_emitted("native", robot_.native);
  add_sin_cos();
  for (const Peer& peer : make_peers(robot_.numbers, states_)) {
    for (const auto& [function, call] : peer.calls) calls_[function][peer.name] = call;
  }
  sweeps_["id_evaluated"][kPlain] = [this] {
    evaluate(robot_.id, kStates, {{"q", q_}, {"dq", dq_}, {"ddq", ddq_}, {"chi", robot_.chi}},
             {{"tau", tau_}});
  };
}

std::size_t Contest::output_size() const {
  const std::size_t n = states_.joints;
  return n * std::max(3 * n, robot_.chi.size());
}

void Contest::add_emitted(const std::string& who, const Emitted& code) {
  const States& s = states_;
  const double* chi = robot_.chi.data();
  const std::size_t n2 = s.joints * s.joints;
  const auto torque = [&](const char* function, Emitted::Torque call, const double* third) {
    calls_[function][who] = [&s, chi, call, third](std::size_t k, double* out) {
      call(&s.q[s.at(k)], &s.dq[s.at(k)], third + s.at(k), chi, out);
    };
  };
  const auto configuration = [&](const char* function, Emitted::Configuration call) {
    calls_[function][who] = [&s, chi, call](std::size_t k, double* out) {
      call(&s.q[s.at(k)], chi, out);
    };
  };
  torque("id", code.id, s.ddq.data());
  torque("id_libm", code.id_libm, s.ddq.data());
  torque("base_regressor", code.base_regressor, s.ddq.data());
  torque("fd", code.fd, s.tau.data());
  configuration("gravity", code.gravity);
  configuration("mass_matrix", code.mass_matrix);
  calls_["id_baked"][who] = [&s, call = code.id_baked](std::size_t k, double* out) {
    call(&s.q[s.at(k)], &s.dq[s.at(k)], &s.ddq[s.at(k)], out);
  };
  calls_["id_derivatives"][who] = [&s, chi, n2, call = code.id_derivatives](std::size_t k,
                                                                            double* out) {
    call(&s.q[s.at(k)], &s.dq[s.at(k)], &s.ddq[s.at(k)], chi, out, out + n2, out + 2 * n2);
  };
  sweeps_["id_batch"][who] = [this, call = code.id_batch] {
    call(kStates, q_.data(), dq_.data(), ddq_.data(), robot_.chi.data(), tau_.data());
  };
  sweeps_["id_batch_float"][who] = [this, call = code.id_batch_float] {
    call(kStates, q_float_.data(), dq_float_.data(), ddq_float_.data(), chi_float_.data(),
         tau_float_.data());
  };
}

/// As many calls of sin and cos as the emitted inverse dynamics makes, and nothing else: what they
/// cost in the C library.
void Contest::add_sin_cos() {
  const auto& instructions = robot_.id.instructions;
  const auto pairs = static_cast<std::size_t>(std::count_if(
      instructions.begin(), instructions.end(),
      [](const Instruction& instruction) { return instruction.op == Instruction::Op::kSin; }));
  calls_["sin_cos"][kPlain] = [pairs, &s = states_](std::size_t k, double* out) {
    const double* q = &s.q[s.at(k)];
    for (std::size_t i = 0; i < pairs; ++i) {
      const std::size_t j = i < s.joints ? i : 0;
      out[j] = std::sin(q[j]) - std::cos(q[j]);
    }
  };
}

bool Contest::agree(const std::string& what, const std::vector<double>& actual,
                    const std::vector<double>& expected, double limit) const {
  const double error = test::relative_error(actual, expected);
  fmt::print("{:<40} differs by {:.1e} of the largest value\n", name() + " " + what, error);
  return error < limit;
}

std::vector<double> Contest::outputs(const StateCall& call, std::size_t size) const {
  std::vector<double> all(kStates * size);
  for (std::size_t k = 0; k < kStates; ++k) call(k, &all[k * size]);
  return all;
}

std::vector<double> Contest::stored_torques() const {
  std::vector<double> torques;
  for (const test::OracleState& state : robot_.stored) {
    std::vector<double> own(states_.joints);
    robot_.plain.id_baked(state.q.data(), state.dq.data(), state.ddq.data(), own.data());
    torques.insert(torques.end(), own.begin(), own.end());
  }
  return torques;
}

/// Central differences of id by q, dq and ddq at the first states, as id_derivatives has them.
std::vector<double> Contest::difference_quotients() const {
  constexpr double kStep = 1e-5;
  const std::size_t n = states_.joints;
  std::vector<double> result;
  for (std::size_t k = 0; k < kDifferentiated; ++k) {
    const auto part = [&](const std::vector<double>& all) {
      return std::vector<double>(&all[states_.at(k)], &all[states_.at(k)] + n);
    };
    std::vector<std::vector<double>> motion = {part(states_.q), part(states_.dq),
                                               part(states_.ddq)};
    for (std::vector<double>& varied : motion) {
      std::vector<double> D(n * n);
      for (std::size_t j = 0; j < n; ++j) {
        std::vector<double> high(n), low(n);
        const double value = varied[j];
        const auto torque = [&](double at, std::vector<double>& tau) {
          varied[j] = at;
          robot_.plain.id(motion[0].data(), motion[1].data(), motion[2].data(), robot_.chi.data(),
                          tau.data());
        };
        torque(value + kStep, high);
        torque(value - kStep, low);
        varied[j] = value;
        for (std::size_t i = 0; i < n; ++i) D[i * n + j] = (high[i] - low[i]) / (2 * kStep);
      }
      result.insert(result.end(), D.begin(), D.end());
    }
  }
  return result;
}

bool Contest::verify_torques() {
  const std::size_t n = states_.joints;
  std::vector<double> stored;
  for (const test::OracleState& state : robot_.stored) {
    stored.insert(stored.end(), state.tau.begin(), state.tau.end());
  }
  bool good = agree("id_baked, stored", stored_torques(), stored, kAgreement);
  const std::vector<double> tau = outputs(calls_["id"][kPlain], n);
  good &= agree("id_libm", outputs(calls_["id_libm"][kPlain], n), tau, kAgreement);
  const std::size_t width = robot_.chi.size();
  std::vector<double> product;
  const std::vector<double> Y = outputs(calls_["base_regressor"][kPlain], n * width);
  for (std::size_t row = 0; row < kStates * n; ++row) {
    double sum = 0;
    for (std::size_t c = 0; c < width; ++c) sum += Y[row * width + c] * robot_.chi[c];
    product.push_back(sum);
  }
  return agree("base_regressor times chi", product, tau, kAgreement) && good;
}

bool Contest::verify_matrices() {
  const std::size_t n = states_.joints;
  bool good = true;
  for (const auto& [function, by_whom] : calls_) {
    const bool square = function == "mass_matrix";
    if (!square && function != "id" && function != "gravity" && function != "fd") continue;
    const std::size_t size = square ? n * n : n;
    const std::vector<double> own = outputs(by_whom.at(kPlain), size);
    for (const auto& [who, call] : by_whom) {
      if (who != kPlain) good &= agree(function + ", " + who, outputs(call, size), own, kAgreement);
    }
  }
  std::vector<double> derivatives(kDifferentiated * 3 * n * n);
  for (std::size_t k = 0; k < kDifferentiated; ++k) {
    calls_["id_derivatives"][kPlain](k, &derivatives[k * 3 * n * n]);
  }
  return agree("id_derivatives, quotients", derivatives, difference_quotients(), kQuotients) &&
         good;
}

bool Contest::verify_batches() {
  const std::size_t n = states_.joints;
  const std::vector<double> tau = joint_major(outputs(calls_["id"][kPlain], n), n);
  bool good = true;
  for (const auto& [function, by_whom] : sweeps_) {
    const bool is_float = function == "id_batch_float";
    for (const auto& [who, sweep] : by_whom) {
      sweep();
      const std::vector<double> own =
          is_float ? std::vector<double>(tau_float_.begin(), tau_float_.end()) : tau_;
      good &= agree(function + ", " + who, own, tau, is_float ? kSingle : kAgreement);
    }
  }
  return good;
}

bool Contest::verify() {
  bool good = verify_torques();
  good &= verify_matrices();
  return verify_batches() && good;
}

}  // namespace dyngen::bench
