// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "runtime/simulation/torque_noise.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectRecordings;

constexpr std::array<const char*, 6> kKindNames = {"null",    "single",  "pair",
                                                   "theorem", "unknown", "time_local"};
constexpr std::array<const char*, 6> kNoiseNames = {"white",       "mixed",        "slow",
                                                    "closed_loop", "rounded_loop", "pink"};
constexpr std::uint64_t kInTurn = 4;   // noises
constexpr double kEncoderNoise = 0.5;  // of the last digit, in a loop

template <class Names>
std::size_t place_of(const Names& names, const std::string& name, const char* what) {
  std::string expected;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i]) return i;
    expected += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  throw std::invalid_argument(fmt::format("{} '{}': expected {}", what, name, expected));
}

/// 1/f noise of variance 1: first order processes whose memories double from one to the next.
VectorXd pink_series(Index samples, std::mt19937_64& random) {
  constexpr int kProcesses = 16;
  std::normal_distribution<double> normal;
  VectorXd series = VectorXd::Zero(samples);
  for (int k = 0; k < kProcesses; ++k) {
    const double pole = std::exp(-1 / std::exp2(k));
    double value = normal(random);
    for (double& x : series) {
      x += value / std::sqrt(kProcesses);
      value = pole * value + std::sqrt(1 - pole * pole) * normal(random);
    }
  }
  return series;
}

std::vector<MatrixXd> noise_of(const Bench& bench, CaseNoise kind, double part,
                               std::mt19937_64& random) {
  runtime::TorqueNoiseOptions options;
  double squares = 0, samples = 0;
  const Index n = bench.robot.joints();
  VectorXd sums = VectorXd::Zero(n);
  for (std::size_t r = 0; r < kTrainRecordings; ++r) {
    sums += bench.plain[r].truth.tau.colwise().squaredNorm().transpose();
    samples += static_cast<double>(bench.plain[r].truth.samples());
  }
  squares = samples;
  options.deviation = part * (sums / squares).cwiseSqrt();
  options.coloured_part = kind == CaseNoise::kWhite ? 0 : kind == CaseNoise::kSlow ? 1 : 0.5;
  options.pole = kind == CaseNoise::kSlow ? 0.95 : 0.9;
  std::vector<MatrixXd> result;
  for (const CaseMotion& motion : bench.plain) {
    runtime::TorqueNoise noise(options, static_cast<int>(n), random());
    MatrixXd values(motion.truth.samples(), n);
    if (kind == CaseNoise::kPink) {
      for (Index j = 0; j < n; ++j) {
        values.col(j) = options.deviation[j] * pink_series(values.rows(), random);
      }
      result.push_back(std::move(values));
      continue;
    }
    for (int k = 0; k < 200; ++k) noise.next();  // the slow part begins as it goes on
    for (Index k = 0; k < values.rows(); ++k) values.row(k) = noise.next();
    result.push_back(std::move(values));
  }
  return result;
}

CaseSettings drawn_settings(const CaseRequest& request, CaseNoise noise, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  CaseSettings settings;
  settings.rate = std::array<double, 3>{250, 400, 500}[random() % 3];
  settings.period = std::array<double, 4>{5, 6, 8, 10}[random() % 4];
  settings.periods = 4 + static_cast<int>(random() % 2);
  settings.closed_loop = noise == CaseNoise::kClosedLoop || noise == CaseNoise::kRoundedLoop;
  settings.encoder_noise = noise == CaseNoise::kClosedLoop ? kEncoderNoise : 0;
  settings.encoder_bits = settings.closed_loop ? 14 + static_cast<int>(random() % 7) : 20;
  settings.bandwidth = 3 + 3 * unit(random);
  settings.temperature = random() % 2 == 0;
  if (request.robot == "ur10e") {  // six joints take long enough
    settings.rate = 250;
    settings.period = std::min(settings.period, 6.0);
    settings.periods = 4;
  }
  if (request.once) {
    settings.period *= settings.periods;
    settings.periods = 1;
  }
  return settings;
}

TruthRequest truth_request(const CaseRequest& request, bool with_likeness) {
  return {request.kind == CaseKind::kPair ? std::size_t{2} : std::size_t{1},
          request.kind == CaseKind::kTimeLocal,
          request.seed,
          request.lambda,
          request.family,
          with_likeness};
}

}  // namespace

std::string case_name(CaseKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }
std::string case_name(CaseNoise noise) { return kNoiseNames[static_cast<std::size_t>(noise)]; }
CaseKind case_kind(const std::string& name) {
  return static_cast<CaseKind>(place_of(kKindNames, name, "kind"));
}
CaseNoise case_noise(const std::string& name) {
  return static_cast<CaseNoise>(place_of(kNoiseNames, name, "noise"));
}

std::string DiagnosisCase::truth_text() const {
  std::string text;
  for (const TrueEffect& effect : truth) {
    text += (text.empty() ? "" : " + ") + effect.effect.law.name;
    if (effect.effect.joint >= 0) text += fmt::format(" {}", effect.effect.joint + 1);
    if (effect.effect.other >= 0) text += fmt::format("<-{}", effect.effect.other + 1);
    if (effect.recording >= 0) text += fmt::format(" in recording {}", effect.recording + 1);
  }
  if (foreign) text += foreign->name;
  return text.empty() ? "null" : text;
}

DiagnosisCase make_case(const CaseRequest& request, bool with_likeness) {
  std::seed_seq sequence{request.seed, static_cast<unsigned>(request.kind),
                         static_cast<unsigned>(std::lround(request.lambda))};
  std::mt19937_64 random(sequence);
  DiagnosisCase result;
  result.request = request;
  // a quarter of the cases each, whatever else the seed decides
  result.noise_kind =
      request.noise ? *request.noise : static_cast<CaseNoise>((request.seed / 3) % kInTurn);
  result.settings = drawn_settings(request, result.noise_kind, random);
  result.robot = case_robot(request.robot, random);
  const CaseSettings& settings = result.settings;

  Bench bench{result.robot, settings, case_trajectories(result.robot, settings, random),
              {},           {},       {}};
  for (const runtime::Trajectory& trajectory : bench.trajectories) {
    bench.seeds.push_back(random());
    bench.plain.push_back(move(result.robot, settings, trajectory, {}, bench.seeds.back()));
  }
  const double part = std::uniform_real_distribution<double>(0.01, 0.03)(random);
  bench.error = noise_of(bench, result.noise_kind, part, random);
  const EffectRecordings plain = plain_recordings(bench, nullptr, -1);
  result.noise = runtime::residual_noise(plain, result.robot.beta);

  switch (request.kind) {
    case CaseKind::kNull:
      break;
    case CaseKind::kTheorem:
      result.truth = {drawn_theorem(bench, request.seed, result.noise, random)};
      break;
    case CaseKind::kUnknown:
      while (result.foreign_strength.lambda == 0) {
        result.foreign = random_foreign_torque(result.robot.joints(), random);
        result.foreign_strength =
            scale_foreign(bench, result.noise, request.lambda, with_likeness, *result.foreign);
      }
      break;
    default:
      result.truth =
          drawn_truth(bench, truth_request(request, with_likeness), result.noise, random);
  }

  for (std::size_t r = 0; r < bench.trajectories.size(); ++r) {
    std::vector<EffectInstance> effects;
    for (const TrueEffect& own : result.truth) {
      if (own.recording < 0 || own.recording == static_cast<int>(r)) effects.push_back(own.effect);
    }
    const CaseMotion motion =
        effects.empty() || !settings.closed_loop
            ? bench.plain[r]
            : move(result.robot, settings, bench.trajectories[r], effects, bench.seeds[r]);
    MatrixXd torque = motion.truth.tau + recorded_share(result.robot, settings, motion, effects);
    if (result.foreign) {
      torque.col(result.foreign->joint) += foreign_torque(*result.foreign, motion.truth);
    }
    auto& sources = r < kTrainRecordings ? result.input.train : result.input.heldout;
    sources.push_back(source_of(bench, motion, torque, r));
  }
  result.input.model = result.robot.told.linear;
  result.input.robot = runtime::effect_robot(result.robot.told);
  result.input.hypotheses =
      all_hypotheses(result.robot, runtime::scales_of(plain, result.robot.beta, -1));
  return result;
}

}  // namespace dyngen::test
