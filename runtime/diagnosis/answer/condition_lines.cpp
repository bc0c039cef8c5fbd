// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/condition_lines.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {
namespace {

/// "a sample every 2.5 ms (400 Hz), jitter 0.3 %"
std::string sampling(const RecordingCondition& condition) {
  std::string text = fmt::format("a sample every {:.4g} ms ({:.4g} Hz)",
                                 1e3 * condition.sample_time, 1 / condition.sample_time);
  if (condition.jitter > 1e-6) text += fmt::format(", jitter {:.2g} %", 100 * condition.jitter);
  return text;
}

/// "encoder steps of joints 1, 2: 1e-05, 2e-05"; one size where all are alike.
std::string quantisation(const std::vector<double>& steps) {
  std::vector<int> joints;
  std::vector<std::string> sizes;
  for (std::size_t j = 0; j < steps.size(); ++j) {
    if (!(steps[j] > 0)) continue;
    joints.push_back(static_cast<int>(j) + 1);
    sizes.push_back(fmt::format("{:.3g}", steps[j]));
  }
  if (joints.empty()) return "no steps of an encoder are seen in the positions";
  if (std::all_of(sizes.begin(), sizes.end(), [&](const auto& own) { return own == sizes[0]; })) {
    sizes.resize(1);
  }
  return fmt::format("encoder steps of joint{} {}: {}", joints.size() == 1 ? "" : "s",
                     fmt::join(joints, ", "), fmt::join(sizes, ", "));
}

ConditionLine line_of(const MotionSource& source) {
  const RecordingCondition& condition = source.condition;
  ConditionLine line{source.name, {}};
  if (condition.sample_time > 0) line.sentences.push_back(sampling(condition));
  if (!condition.position_step.empty()) {
    line.sentences.push_back(quantisation(condition.position_step));
  }
  for (const Notice& repair : condition.repairs) line.sentences.push_back(repair.text());
  line.sentences.insert(line.sentences.end(), condition.messages.begin(), condition.messages.end());
  return line;
}

/// "the motion repeats every 5 s, 4.0 times"; "its motion is that of run1.csv"
std::string repetition(const EffectRun& run, double equations, const std::string& earlier) {
  if (!(equations > 0)) {
    return earlier.empty() ? "the motion does not repeat" : "its motion is that of " + earlier;
  }
  const double row_time = run.motion.sample_time * static_cast<double>(run.decimator.factor);
  return fmt::format("the motion repeats every {:.5g} s, {:.1f} times", equations * row_time,
                     static_cast<double>(run.rows.Y.rows()) / equations);
}

}  // namespace

std::vector<ConditionLine> condition_lines(const DiagnosisInput& input, const Division& parts,
                                           const EffectRecordings* train) {
  std::vector<ConditionLine> lines;
  for (const auto* sources : {&input.train, &input.heldout, &input.reference}) {
    for (const MotionSource& source : *sources) lines.push_back(line_of(source));
  }
  if (train == nullptr) return lines;
  const std::vector<double> repeats = repeats_of(*train);
  for (std::size_t run = 0; run < repeats.size(); ++run) {
    const int recording = train->runs[run].recording;
    if (recording < 0) continue;
    auto& sentences = lines.at(parts.origin_of(static_cast<std::size_t>(recording))).sentences;
    std::string earlier;
    if (const auto& same = train->runs[run].earlier) {
      const int place = train->runs[same->run].recording;
      if (place == recording) {
        earlier = "an earlier part";
      } else if (place >= 0) {
        earlier = lines.at(parts.origin_of(static_cast<std::size_t>(place))).recording;
      }
    }
    const std::string sentence = repetition(train->runs[run], repeats[run], earlier);
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end()) {
      sentences.push_back(sentence);
    }
  }
  return lines;
}

}  // namespace dyngen::runtime
