// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/search.h"

#include <cstdint>
#include <vector>

#include "gen/passes/workspace.h"

namespace dyngen {
namespace {

/// Sums that get longer than this are left: the pairs of their terms are too many.
constexpr std::size_t kMostWrittenOut = 16;

/// A small program needs more tries per sum.
constexpr int kTriesOfSmallest = 100;

/// Numbers that look random and are the same everywhere (splitmix64: Steele, Lea and Flood 2014).
class Random {
 public:
  std::uint64_t operator()() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  int below(int bound) { return static_cast<int>((*this)() % static_cast<std::uint64_t>(bound)); }

 private:
  std::uint64_t state_ = 1;
};

std::vector<int> live_sums(const Workspace& workspace) {
  std::vector<int> result;
  for (int id = 0; id < workspace.network().size(); ++id) {
    if (workspace.is_live_sum(id)) result.push_back(id);
  }
  return result;
}

/// One, two or three sums at once.
int how_many(Random& random) {
  return 1 + (random.below(4) == 0 ? 1 : 0) + (random.below(8) == 0 ? 1 : 0);
}

}  // namespace

Network searched(const Network& network, const SearchOptions& options) {
  Workspace workspace(network);
  workspace.settle(0);
  Random random;
  workspace.begin();
  std::vector<int> sums = live_sums(workspace);
  const auto tries = [&] {
    return options.patience * (static_cast<int>(sums.size()) + kTriesOfSmallest);
  };
  int left = sums.empty() ? 0 : tries();
  while (left-- > 0 && workspace.work() < options.work) {
    workspace.begin();
    const int before = workspace.operations();
    for (int k = how_many(random); k > 0; --k) {
      const int id = sums[static_cast<std::size_t>(random.below(static_cast<int>(sums.size())))];
      if (workspace.is_live_sum(id)) workspace.write_out(id, kMostWrittenOut);
    }
    workspace.settle(random() | 1);
    if (workspace.operations() > before) {
      workspace.roll_back();
      continue;
    }
    sums = live_sums(workspace);
    if (sums.empty()) break;
    if (workspace.operations() < before) left = tries();
  }
  return workspace.network();
}

}  // namespace dyngen
