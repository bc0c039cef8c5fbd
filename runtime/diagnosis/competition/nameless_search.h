// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/competition/beside_white_noise.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"

namespace dyngen::runtime {

/// Structure that no effect of the catalogue explains. What is found becomes part of the model, so
/// that effects are looked for beside it.
class NamelessSearch {
 public:
  /// All must outlive it.
  /// @param heldout  what was found in the others is held against them
  /// @param result   what was found so far; grows
  NamelessSearch(const EffectRecordings& data, EffectSignals& signals,
                 const EffectRecordings& heldout, const std::vector<Hypothesis>& hypotheses,
                 const std::vector<GenericStructure>& structures, const StictionImpulses& stiction,
                 HalfBandTest& half_band, const EvidenceSystem::Options& options,
                 double false_alarm, CompetitionResult& result)
      : data_(data),
        signals_(signals),
        heldout_(heldout),
        hypotheses_(hypotheses),
        structures_(structures),
        stiction_(stiction),
        half_band_(half_band),
        options_(options),
        false_alarm_(false_alarm),
        result_(result) {}

  /// The strongest structure of a round: a joint that sticks, the form of an effect that a bound or
  /// a falsifier rules out, or any function of the motion. @return whether there is any
  bool next(const EvidenceSystem& system, const Screening& screening);

  /// Where no motion repeats: the likeliest function of the motion, if held-out recordings have it
  /// too, beside noise that is known without it. @return whether there is one
  bool next_likely(const ModelSide& plain);

  /// Generic structure that `costly` would explain, for more parameters than the data pay for.
  /// @return false if the half_band contradicts it
  bool describe(const GenericResult& generic, const EvidenceSystem& system,
                const std::string& costly) {
    return describe(generic, system, costly, false);
  }

  /// Whether structure may be said to be there although nothing that is held out speaks for it.
  [[nodiscard]] bool sure(const Screening& screening, double surprise) const;
  /// Whether some of it was said to be what a costly effect would explain.
  [[nodiscard]] bool is_costly(const std::string& effect) const;

 private:
  struct RuledOut {
    NamedResult named;
    std::vector<int> joints;  ///< that it acts on
    double net;               ///< net_of()
  };

  bool next_ruled_out(const EvidenceSystem& system, const Screening& screening);
  [[nodiscard]] std::vector<RuledOut> ruled_out(const Screening& screening) const;
  [[nodiscard]] const RuledOut* strongest_apart_from_stiction(
      const std::vector<RuledOut>& candidates, const EvidenceSystem& system,
      const Screening& screening) const;
  [[nodiscard]] double structure_surprise(const Screening& screening,
                                          const std::vector<int>& joints) const;
  [[nodiscard]] std::vector<int> joints_of_hypothesis(std::size_t place) const;
  [[nodiscard]] std::vector<const GenericResult*> candidates(const Screening& screening) const;
  bool describe(const GenericResult& generic, const EvidenceSystem& system,
                const std::string& costly, bool needs_proof);
  bool is_proved(const Nameless& nameless, bool needs_proof);
  bool add(Nameless nameless, const EvidenceSystem& system, bool needs_proof = false);

  const EffectRecordings& data_;
  EffectSignals& signals_;
  const EffectRecordings& heldout_;
  const std::vector<Hypothesis>& hypotheses_;
  const std::vector<GenericStructure>& structures_;
  const StictionImpulses& stiction_;
  HalfBandTest& half_band_;
  EvidenceSystem::Options options_;
  double false_alarm_;
  CompetitionResult& result_;
};

}  // namespace dyngen::runtime
