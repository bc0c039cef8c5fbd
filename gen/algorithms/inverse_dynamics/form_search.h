// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace dyngen {

/// Finds a combination of the links' forms that costs little: every change of one link by itself,
/// again and again, until none helps or all trials are used up.
template <class Form>
class FormSearch {
 public:
  using Forms = std::vector<Form>;  ///< one for each link

  /// @param cost    of a combination
  /// @param trials  how often it may be asked for
  FormSearch(std::function<int(const Forms&)> cost, int trials)
      : cost_(std::move(cost)), trials_left_(trials) {}

  void try_forms(const Forms& forms) {
    if (best_cost_ >= 0 && trials_left_ <= 0) return;
    --trials_left_;
    const int cost = cost_(forms);
    if (best_cost_ >= 0 && cost >= best_cost_) return;
    best_ = forms;
    best_cost_ = cost;
  }

  /// @param changes  other forms of a link, given all of them and the link's place
  void descend(const std::function<Forms(const Forms&, std::size_t)>& changes) {
    // from the tips to the base, and round again until one round brings nothing
    for (std::size_t idle = 0, at = best_.size(); idle < best_.size(); ++idle) {
      at = (at == 0 ? best_.size() : at) - 1;
      const int before = best_cost_;
      for (const Form& form : changes(best_, at)) {
        Forms trial = best_;
        trial[at] = form;
        try_forms(trial);
      }
      if (best_cost_ < before) idle = 0;
    }
  }

  [[nodiscard]] const Forms& best() const { return best_; }

 private:
  std::function<int(const Forms&)> cost_;
  int trials_left_ = 0;
  Forms best_;
  int best_cost_ = -1;
};

}  // namespace dyngen
