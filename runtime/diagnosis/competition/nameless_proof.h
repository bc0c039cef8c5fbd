// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/heldout.h"

namespace dyngen::runtime {

/// Whether held-out recordings can speak of structure without a name: of a function of the motion,
/// of a wave, of a sinusoid that goes on by itself, and of an effect that a condition rules out;
/// not of what depends on time or comes back in a period of its own.
bool is_provable(const Nameless& nameless);

/// The recordings of a proof. All of them outlive it.
struct ProofData {
  const EffectRecordings& evidence;  ///< that the size is from
  EffectSignals& signals;            ///< of these
  const EffectRecordings& heldout;
};

/// What they say of it, with the functions and the size that it has in the fitted ones: squares of
/// what a refit of the model, and of all else that was found, leaves of them.
/// @param noise  of the torque, which need not be that of the result
HeldoutProof nameless_proof(const ProofData& data, const std::vector<Hypothesis>& hypotheses,
                            const CompetitionResult& result, const TorqueNoiseModel& noise,
                            const Nameless& nameless, EvidenceSystem::Options options);

/// The same of an effect with its estimated parameters, beside a result that lacks it.
HeldoutProof effect_proof(const ProofData& data, const std::vector<Hypothesis>& hypotheses,
                          const CompetitionResult& result, const TorqueNoiseModel& noise,
                          const EffectInstance& effect, EvidenceSystem::Options options);

/// Whether that is enough to say it. They have to have it too; of what is beyond doubt in the
/// fitted ones they must not speak against it. A form without a name is a sketch: where they have
/// it at all, they may have less of it than was said.
bool is_supported(const HeldoutProof& proof, bool beyond_doubt);

}  // namespace dyngen::runtime
