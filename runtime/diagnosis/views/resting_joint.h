// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace dyngen::runtime {

/// A joint that friction holds for an instant where it turns.
struct RestingJoint {
  int joint = 0;
  double squares = 0;  ///< of the impulses at its reversals, beside the model and what was found
  std::vector<int> recordings;  ///< of the fitted ones, ascending: where they are seen

  [[nodiscard]] bool rests_in(int recording) const {
    return std::binary_search(recordings.begin(), recordings.end(), recording);
  }
};

/// Adds what was found to what is known. @return whether anything of it is new
inline bool join(std::vector<RestingJoint>& known, const std::vector<RestingJoint>& found) {
  bool grown = false;
  for (const RestingJoint& resting : found) {
    const auto same = std::find_if(known.begin(), known.end(), [&](const RestingJoint& other) {
      return other.joint == resting.joint;
    });
    if (same == known.end()) {
      known.push_back(resting);
      grown = true;
      continue;
    }
    std::vector<int> all;
    std::set_union(same->recordings.begin(), same->recordings.end(), resting.recordings.begin(),
                   resting.recordings.end(), std::back_inserter(all));
    grown = grown || all.size() > same->recordings.size();
    same->recordings = std::move(all);
  }
  return grown;
}

}  // namespace dyngen::runtime
