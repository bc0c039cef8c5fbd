// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/rival_families.h"

#include <algorithm>
#include <utility>

namespace dyngen::runtime {

void drop_what_adds_nothing(std::vector<Rival>& rivals, const std::vector<Hypothesis>& hypotheses,
                            const std::string& family, double net) {
  std::map<std::string, double> explained = {{family, net}};
  for (const Rival& rival : rivals) {
    const auto entry = explained.try_emplace(rival.family, rival.distance).first;
    entry->second = std::max(entry->second, rival.distance);
  }
  std::erase_if(rivals, [&](const Rival& rival) {
    const std::vector<std::string>& parts = hypotheses[rival.hypothesis].effect.law.contains;
    return std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
      const auto entry = explained.find(part);
      return entry != explained.end() && entry->second >= rival.distance;
    });
  });
}

std::map<std::string, Rival> best_of_families(std::vector<Rival> rivals) {
  std::map<std::string, Rival> best;
  for (Rival& rival : rivals) {
    const auto [entry, added] = best.try_emplace(rival.family, rival);
    Rival& known = entry->second;
    const double apart = std::min(known.apart, rival.apart);
    if (!added && rival.distance > known.distance) known = std::move(rival);
    known.apart = apart;
  }
  return best;
}

}  // namespace dyngen::runtime
