// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/structure_screening.h"

#include <map>
#include <utility>

#include "runtime/diagnosis/scans/generic_columns.h"
#include "runtime/diagnosis/scans/line_scan.h"
#include "runtime/diagnosis/scans/repeat_scan.h"
#include "runtime/diagnosis/scans/wave_scan.h"

namespace dyngen::runtime {
namespace {

using Form = GenericStructure::Form;

/// Whether columns do not ask on which joint they act.
bool is_shared(const GenericStructure& structure) {
  return structure.form == Form::kFunction || structure.form == Form::kSpeeds ||
         structure.form == Form::kWave;
}

/// One group's structures, each on its joint.
class Group {
 public:
  Group(const ScreeningData& data, ScreeningData::Reader& reader, const EvidenceSystem& system,
        const GenericStructure& first, bool surrogates)
      : data_(data), reader_(reader), system_(system), surrogates_(surrogates) {
    if (first.form == Form::kWave) {
      waves_ = waves_of(data.coarse(), first.variables[0].joint, first.variables[1].joint);
    } else if (is_shared(first)) {
      shapes_ = function_shapes(data.coarse(), reader.coarse, first);
    }
  }

  [[nodiscard]] GenericResult result_of(const GenericStructure& structure) const {
    GenericResult result;
    const int joint = structure.joint;
    double worth = system_.worth(joint);
    switch (structure.form) {
      case Form::kLine: {
        LineScan scan = scan_lines(data_.whole(), system_, joint, surrogates_);
        result.frequency[0] = scan.frequency;
        result.score = std::move(scan.score);
        break;
      }
      case Form::kRepeats: {
        RepeatScan scan =
            scan_repeats(data_.coarse(), system_, joint, data_.repeats(), surrogates_);
        result.frequency[0] = scan.frequency;
        result.score = std::move(scan.score);
        worth = std::min(worth, std::max(scan.worth, 1.0));
        break;
      }
      case Form::kWave: {
        WaveScan scan = scan_waves(data_.coarse(), system_, joint, waves_, surrogates_);
        result.frequency = scan.frequency;
        result.score = std::move(scan.score);
        break;
      }
      case Form::kFunction:
      case Form::kSpeeds:
        result.score = score(counted_columns(data_.coarse(), joint, shapes_));
        break;
      case Form::kFriction:
        result.score = score(generic_columns(data_.coarse(), reader_.coarse, structure));
        break;
      case Form::kImpulses:
        result.score = score(generic_columns(data_.whole(), reader_.whole, structure));
        break;
    }
    result.surprise = surprise_of(result.score.delta_chi2, result.score.degrees, worth);
    return result;
  }

 private:
  [[nodiscard]] Score score(JointColumns columns) const {
    return score_of(system_.products(system_.whitened(std::move(columns)), surrogates_),
                    surrogates_);
  }

  const ScreeningData& data_;
  ScreeningData::Reader& reader_;
  const EvidenceSystem& system_;
  bool surrogates_;
  Waves waves_;
  Eigen::MatrixXd shapes_;
};

}  // namespace

std::vector<std::vector<std::size_t>> structure_groups(
    const std::vector<GenericStructure>& structures) {
  using Variables = std::vector<std::pair<StructureVariable::Kind, int>>;
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::pair<Form, Variables>, std::size_t> shared;
  for (std::size_t place = 0; place < structures.size(); ++place) {
    const GenericStructure& structure = structures[place];
    if (is_shared(structure)) {
      Variables variables;
      for (const StructureVariable& variable : structure.variables) {
        variables.emplace_back(variable.kind, variable.joint);
      }
      const auto [group, added] =
          shared.try_emplace({structure.form, std::move(variables)}, groups.size());
      if (!added) {
        groups[group->second].push_back(place);
        continue;
      }
    }
    groups.push_back({place});
  }
  return groups;
}

std::vector<GenericResult> screen_structures(const ScreeningData& data,
                                             ScreeningData::Reader& reader,
                                             const EvidenceSystem& system,
                                             const std::vector<GenericStructure>& structures,
                                             const std::vector<std::size_t>& group,
                                             bool surrogates) {
  const Group members(data, reader, system, structures[group.front()], surrogates);
  std::vector<GenericResult> results;
  for (const std::size_t place : group) {
    results.push_back(members.result_of(structures[place]));
    results.back().structure = place;
  }
  return results;
}

}  // namespace dyngen::runtime
