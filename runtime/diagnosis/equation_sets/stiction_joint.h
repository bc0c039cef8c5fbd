// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace dyngen::runtime {

/// A joint that friction holds for an instant where it turns.
struct StictionJoint {
  int joint = 0;
  double squares = 0;  ///< of the impulses at its reversals, beside the model and what was found
  std::vector<int> recordings;  ///< of the fitted ones, ascending: where they are seen

  [[nodiscard]] bool sticks_in(int recording) const {
    return std::binary_search(recordings.begin(), recordings.end(), recording);
  }
};

/// Adds what was found to what is known. @return whether anything of it is new
inline bool join(std::vector<StictionJoint>& known, const std::vector<StictionJoint>& found) {
  bool grown = false;
  for (const StictionJoint& sticking : found) {
    const auto same = std::find_if(known.begin(), known.end(), [&](const StictionJoint& other) {
      return other.joint == sticking.joint;
    });
    if (same == known.end()) {
      known.push_back(sticking);
      grown = true;
      continue;
    }
    std::vector<int> all;
    std::set_union(same->recordings.begin(), same->recordings.end(), sticking.recordings.begin(),
                   sticking.recordings.end(), std::back_inserter(all));
    grown = grown || all.size() > same->recordings.size();
    same->recordings = std::move(all);
  }
  return grown;
}

}  // namespace dyngen::runtime
