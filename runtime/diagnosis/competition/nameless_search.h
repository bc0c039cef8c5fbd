// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnosis/competition/beside_white_noise.h"
#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/sought.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"

namespace dyngen::runtime {

/// Structure that no effect of the catalogue explains. What is found becomes part of the model, so
/// that effects are looked for beside it.
class NamelessSearch {
 public:
  /// All but the options must outlive it. @param false_alarm  as in CompetitionOptions
  /// @param result  what was found so far
  NamelessSearch(const CompetitionData& data, const Sought& sought,
                 const StictionImpulses& stiction, const EvidenceSystem::Options& options,
                 double false_alarm, const CompetitionResult& result)
      : data_(data),
        sought_(sought),
        stiction_(stiction),
        options_(options),
        false_alarm_(false_alarm),
        result_(result) {}

  /// Joints that begin to rest, if that may be all that the strongest structure of a round is: what
  /// sticks jolts the whole arm, and is asked before anything is said without a name.
  [[nodiscard]] std::vector<StictionJoint> sticking(const EvidenceSystem& system,
                                                    const Screening& screening) const;
  /// The strongest structure of a round: the form of an effect that a bound or a falsifier rules
  /// out, or any function of the motion.
  [[nodiscard]] std::optional<Nameless> next(const EvidenceSystem& system,
                                             const Screening& screening) const;

  /// Where no motion repeats: the likeliest function of the motion, if held-out recordings have it
  /// too, beside noise that is known without it.
  [[nodiscard]] std::optional<Nameless> next_likely(const ModelSide& plain) const;

  /// Generic structure that `costly` would explain, for more parameters than the data pay for.
  /// @return nothing if held-out recordings, the half-band test or its own residual contradict it
  [[nodiscard]] std::optional<Nameless> described(const GenericResult& generic,
                                                  const EvidenceSystem& system,
                                                  const std::string& costly) const {
    return confirmed(nameless_of(generic, costly), system, result_.noise, false);
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

  [[nodiscard]] std::optional<Nameless> next_ruled_out(const EvidenceSystem& system,
                                                       const Screening& screening) const;
  [[nodiscard]] std::vector<RuledOut> ruled_out(const Screening& screening) const;
  [[nodiscard]] const RuledOut* strongest_apart_from_stiction(
      const std::vector<RuledOut>& candidates, const EvidenceSystem& system,
      const Screening& screening) const;
  [[nodiscard]] double structure_surprise(const Screening& screening,
                                          const std::vector<int>& joints) const;
  [[nodiscard]] std::vector<const GenericResult*> candidates(const Screening& screening) const;
  [[nodiscard]] Nameless nameless_of(const GenericResult& generic, const std::string& costly) const;
  [[nodiscard]] bool is_proved(const Nameless& nameless, const TorqueNoiseModel& noise,
                               bool needs_proof) const;
  [[nodiscard]] bool is_disturbance(const Nameless& nameless, const JointColumns& white,
                                    const EvidenceSystem& system,
                                    const TorqueNoiseModel& noise) const;
  [[nodiscard]] std::optional<Nameless> confirmed(Nameless nameless, const EvidenceSystem& system,
                                                  const TorqueNoiseModel& noise,
                                                  bool needs_proof) const;

  const CompetitionData& data_;
  const Sought& sought_;
  const StictionImpulses& stiction_;
  EvidenceSystem::Options options_;
  double false_alarm_;
  const CompetitionResult& result_;
};

}  // namespace dyngen::runtime
