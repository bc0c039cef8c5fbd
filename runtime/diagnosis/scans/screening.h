// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// A named hypothesis beside the model, at the best of its trial shapes.
struct NamedResult {
  std::size_t hypothesis = 0;  ///< its place
  TrialScore best;      ///< of those that are admissible the one with most squares, priced; of all
                        ///< where none is
  TrialScore freest;    ///< of all: more than the best one, which a condition limits
  double surprise = 0;  ///< -ln p, at the best shape
  double slow_noise =
      1;  ///< of an event: its chi-square relative to white noise, WindowScan::elsewhere
  double worth = 1e9;         ///< independent samples that the noise of its joints is known by
  double typical_lambda = 0;  ///< noncentrality of the typical size, at the typical shapes
  double part_left = 0;       ///< of the typical size's chi-square, after the refit of the model
  Eigen::VectorXd typical;    ///< (linear) typical sizes
  bool seen = true;           ///< false: the motion does not excite it, or a signal is missing
};

/// Of its best trial. Slow noise gives an event the chi-square that it gives other windows.
double surprise_of(const NamedResult& named);

/// Degrees of freedom of a trial whose shapes were found by refined(): each shape counts as one.
/// The noise surrogates have the chi-square of the grid's shapes only, and would understate the
/// refined ones. (Davies 1987: a search along one parameter.)
int degrees_of_refined(const NamedResult& named, const Hypothesis& hypothesis);

/// The surprise with as many; not less than what it was at the grid's shapes.
double surprise_of_refined(const NamedResult& named, const Hypothesis& hypothesis);

/// The same at what fits best whatever conditions say.
NamedResult without_conditions(const NamedResult& named);

struct GenericResult {
  std::size_t structure = 0;                            ///< its place
  Eigen::Vector2d frequency = Eigen::Vector2d::Zero();  ///< of a line, a wave, of what repeats
  Score score;
  double surprise = 0;  ///< -ln p
};

/// Every hypothesis beside one model.
struct Screening {
  std::vector<NamedResult> named;      ///< all hypotheses, in their order
  std::vector<GenericResult> generic;  ///< all structures, in their order
  /// How many independent tests all of them together are worth, from noise surrogates.
  double tests = 1;

  /// P that noise alone gives a surprise as large, somewhere among all tests.
  [[nodiscard]] double family_wise(double surprise) const;
  /// The surprise that has this P. @param false_alarm  in (0, 1)
  [[nodiscard]] double threshold(double false_alarm) const;
};

/// The noncentrality at which a test of one parameter exceeds a surprise nine times in ten.
double detectable_lambda(double surprise);

/// Told how far it is, 0 .. 1; from the calling thread.
using ScreeningProgress = std::function<void(double done)>;

/// The recordings as screening reads them: whole, and at the equations alone. Signals are kept from
/// one screening to the next.
class ScreeningData {
 public:
  /// @param data  must outlive it
  explicit ScreeningData(const EffectRecordings& data);
  ScreeningData(const ScreeningData&) = delete;
  ScreeningData& operator=(const ScreeningData&) = delete;

  void set_beta(const Eigen::VectorXd& beta);

  /// What one thread reads.
  struct Reader {
    EffectSignals whole, coarse;
  };
  [[nodiscard]] const EffectRecordings& whole() const { return whole_; }
  [[nodiscard]] const EffectRecordings& coarse() const { return coarse_; }
  [[nodiscard]] std::vector<Reader>& readers() { return readers_; }
  /// As of repeats_of().
  [[nodiscard]] const std::vector<double>& repeats() const { return repeats_; }

 private:
  const EffectRecordings& whole_;
  EffectRecordings coarse_;
  std::vector<Reader> readers_;
  std::vector<double> repeats_;
};

/// Scores of everything. Effects without memory, and structures, are looked at at the equations
/// alone; those that remember or repeat with position at all samples. Runs on all processors; what
/// it gives does not depend on how many there are.
/// @param before  an earlier screening of the same hypotheses: then the shapes that were best there
///                are tried again, not the whole grid, and the number of tests is taken from it
/// @param known   results of all structures beside this system, with surrogates, where they are
///                known already
Screening screen(ScreeningData& data, const EvidenceSystem& system, const ScaleTable& scales,
                 const Eigen::VectorXd& beta, const std::vector<Hypothesis>& hypotheses,
                 const std::vector<GenericStructure>& structures, const Screening* before,
                 const ScreeningProgress& progress = {},
                 const std::vector<GenericResult>& known = {});

/// Shapes between the grid's, by a search that halves its steps.
TrialScore refined(const EffectRecordings& data, EffectSignals& signals,
                   const EvidenceSystem& system, const Hypothesis& hypothesis, TrialScore best,
                   const EffectScales& scales);

/// -ln P(X > squares), X of the chi-square distribution; also where P is too small for a double.
double surprise_of(double squares, int degrees);
/// The same where the level of the noise is itself estimated: of Fisher's F.
/// @param worth  independent samples that it is known by
double surprise_of(double squares, int degrees, double worth);

}  // namespace dyngen::runtime
