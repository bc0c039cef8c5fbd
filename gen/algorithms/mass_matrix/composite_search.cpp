// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/mass_matrix/composite_search.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace dyngen {
namespace {

using StationKind = Station::Kind;
constexpr StationKind kKinds[] = {
    StationKind::kLink,       StationKind::kTurned,    StationKind::kSlid,
    StationKind::kTurnedSlid, StationKind::kParent,    StationKind::kSlidToFirst,
    StationKind::kChain,      StationKind::kChainSlid, StationKind::kChainSlidToFirst};

// About half a second on a slow machine; arms of seven joints need a fifth of it.
constexpr std::size_t kStatementsAllowed = 800'000;

class Search {
 public:
  Search(const DraftLeaves& leaves, const CompositeRobot& robot)
      : leaves_(leaves), robot_(robot), best_(first_choices(robot)) {
    fewest_ = count(best_);
  }

  CompositeChoices run() {
    int before = fewest_ + 1;
    while (fewest_ < before && !tired()) {
      before = fewest_;
      change_chains();
      change_common_meetings();
      change_routes();
      change_meetings();
    }
    return best_;
  }

 private:
  [[nodiscard]] bool tired() const { return spent_ > kStatementsAllowed; }

  int count(const CompositeChoices& choices) {
    Draft draft(leaves_);
    for (const auto& row : draft_mass_elements(draft, robot_, choices)) {
      for (const DraftValue& value : row) draft.want(value);
    }
    spent_ += draft.statement_count();
    return draft.count();
  }

  void try_choices(const CompositeChoices& choices) {
    if (tired()) return;

    const int operations = count(choices);
    if (operations >= fewest_) return;
    fewest_ = operations;
    best_ = choices;
  }

  /// False where a wrench does not pass, or the step before changes no more than names.
  [[nodiscard]] bool worth_trying(const Station& station) const {
    const CompositeRobot::Link& link = robot_.link(station.link);
    const Route route = best_.wrench[static_cast<std::size_t>(station.link)];
    const bool to_first = best_.slide_to_first[static_cast<std::size_t>(link.first)];
    switch (station.kind) {
      case StationKind::kLink:
        return true;
      case StationKind::kTurned:
        return route == Route::kTurnThenSlide || !link.parallel;
      case StationKind::kSlid:
        return route == Route::kSlideThenTurn && !link.r.is_zero();
      case StationKind::kTurnedSlid:
        return route == Route::kSlideThenTurn || !link.r.is_zero();
      case StationKind::kParent:
        return !link.alpha.sin.is_zero() && !link.alpha.cos.is_zero();
      case StationKind::kChain:
        return link.parallel && !to_first;
      case StationKind::kChainSlid:
        return link.parallel && !to_first && !link.r.is_zero();
      case StationKind::kSlidToFirst:
      case StationKind::kChainSlidToFirst:
        return link.parallel && to_first;
    }
    return true;
  }

  /// All links of a chain together.
  void change_chains() {
    constexpr Route kRoutes[] = {Route::kTurnThenSlide, Route::kSlideThenTurn, Route::kChain};
    for (int first = 1; first <= robot_.size(); ++first) {
      std::vector<std::size_t> links;
      for (int k = first + 1; k <= robot_.size(); ++k) {
        if (robot_.link(k).parallel && robot_.link(k).first == first) {
          links.push_back(static_cast<std::size_t>(k));
        }
      }
      if (links.empty()) continue;
      for (const Route body : kRoutes) {
        for (const Route wrench : kRoutes) {
          for (const Route screw : kRoutes) {
            CompositeChoices changed = best_;
            for (const std::size_t k : links) {
              changed.body[k] = body;
              changed.wrench[k] = wrench;
              changed.screw[k] = screw;
            }
            try_choices(changed);
          }
        }
      }
    }
  }

  /// Many columns meet the screws of one joint, or of all, in one place: its cost is shared.
  void change_common_meetings() {
    for (int c = robot_.size(); c >= 1; --c) {
      for (const StationKind kind : kKinds) {
        if (!worth_trying({kind, c})) continue;
        CompositeChoices all = best_;
        for (int i = robot_.link(c).parent; i >= 1; i = robot_.link(i).parent) {
          CompositeChoices one = best_;
          for (int j = c; j <= robot_.size(); ++j) {
            if (robot_.is_ancestor(c, j)) one.meeting[{i, j}] = all.meeting[{i, j}] = {kind, c};
          }
          try_choices(one);
        }
        try_choices(all);
      }
    }
  }

  void change_routes() {
    const auto try_route = [&](std::vector<Route> CompositeChoices::*routes, int k,
                               std::initializer_list<Route> options) {
      for (const Route route : options) {
        CompositeChoices changed = best_;
        (changed.*routes)[static_cast<std::size_t>(k)] = route;
        try_choices(changed);
      }
    };
    for (int k = 1; k <= robot_.size(); ++k) {
      const bool parallel = robot_.link(k).parallel;
      if (!parallel && robot_.link(k).r.is_zero()) continue;  // there is one way only
      for (const auto routes : {&CompositeChoices::body, &CompositeChoices::wrench}) {
        try_route(routes, k, {Route::kTurnThenSlide, Route::kSlideThenTurn});
        if (parallel) try_route(routes, k, {Route::kChain});
      }
      try_route(&CompositeChoices::screw, k, {Route::kTurnThenSlide, Route::kSlideThenTurn});
      if (parallel) {
        try_route(&CompositeChoices::screw, k, {Route::kChain, Route::kChainSlidToFirst});
      }
      // body and wrench share statements where they take the same way
      for (const Route route : {Route::kTurnThenSlide, Route::kSlideThenTurn, Route::kChain}) {
        if (route == Route::kChain && !parallel) continue;
        CompositeChoices changed = best_;
        changed.body[static_cast<std::size_t>(k)] = route;
        changed.wrench[static_cast<std::size_t>(k)] = route;
        try_choices(changed);
      }
      if (robot_.link(k).first == k) {
        CompositeChoices changed = best_;
        changed.slide_to_first[static_cast<std::size_t>(k)] =
            !changed.slide_to_first[static_cast<std::size_t>(k)];
        try_choices(changed);
      }
    }
  }

  void change_meetings() {
    for (int j = 1; j <= robot_.size(); ++j) {
      if (!robot_.link(j).moving) continue;
      for (int i = robot_.link(j).parent; i >= 1; i = robot_.link(i).parent) {
        if (!robot_.link(i).moving) continue;
        Draft draft(leaves_);
        const std::vector<Station> path = CompositeDraft(draft, robot_, best_).stations(i, j);
        for (const Station& station : path) {
          if (!worth_trying(station)) continue;
          CompositeChoices changed = best_;
          changed.meeting[{i, j}] = station;
          try_choices(changed);
        }
      }
    }
  }

  const DraftLeaves& leaves_;
  const CompositeRobot& robot_;
  CompositeChoices best_;
  int fewest_ = 0;
  std::size_t spent_ = 0;
};

}  // namespace

std::vector<std::vector<DraftValue>> draft_mass_elements(Draft& draft, const CompositeRobot& robot,
                                                         const CompositeChoices& choices) {
  const std::size_t count = static_cast<std::size_t>(robot.size()) + 1;
  std::vector<std::vector<DraftValue>> M(count, std::vector<DraftValue>(count));
  CompositeDraft composite(draft, robot, choices);
  for (int j = robot.size(); j >= 1; --j) {
    if (!robot.link(j).moving) continue;
    draft.section("joint ", j,
                  ", unit acceleration: FF force, FN moment that the links it carries need; SW "
                  "angular, SV linear motion of the joints below");
    for (int i = j; i >= 1; --i) {
      if (!robot.link(i).moving) continue;
      DraftValue& value = M[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      value = composite.element(i, j);
      if (i == j) value = draft.assign({"M", 0, j, j}, value + robot.link(j).IA);
    }
  }
  return M;
}

CompositeChoices first_choices(const CompositeRobot& robot) {
  CompositeChoices choices;
  const std::size_t count = static_cast<std::size_t>(robot.size()) + 1;
  choices.body.resize(count, Route::kTurnThenSlide);
  choices.wrench = choices.screw = choices.body;
  choices.slide_to_first.resize(count, false);
  for (int k = 1; k <= robot.size(); ++k) {
    if (!robot.link(k).parallel) continue;
    choices.body[static_cast<std::size_t>(k)] = Route::kChain;
    choices.screw[static_cast<std::size_t>(k)] = Route::kChain;
  }
  return choices;
}

CompositeChoices shortest_choices(const DraftLeaves& leaves, const CompositeRobot& robot) {
  return Search(leaves, robot).run();
}

}  // namespace dyngen
