// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/inverse_dynamics/rnea_search.h"

#include <algorithm>
#include <vector>

#include "gen/algorithms/inverse_dynamics/form_search.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

/// A trial of a robot with n joints takes some n/2 ms: the search may take about 0.1 s.
int trials(const CodeModel& code) { return std::clamp(240 / std::max(1, code.size()), 8, 40); }

/// What a change of form can bring depends on where a link is.
class Robot {
 public:
  explicit Robot(const CodeModel& code) : code_(code) {}

  [[nodiscard]] bool is_tip(int j) const {
    return std::none_of(code_.links.begin(), code_.links.end(),
                        [&](const CodeLink& link) { return link.parent == j; });
  }
  [[nodiscard]] bool is_parallel(int j) const {
    const CodeLink& link = code_.link(j);
    return link.parent != 0 && is_zero_number(GiNaC::sin(link.alpha));
  }
  /// Its axis frame stands on the base, or on a link of the base.
  [[nodiscard]] bool is_near_base(int j) const {
    while (is_parallel(j)) j = code_.link(j).parent;
    const int anchor = code_.link(j).parent;
    return anchor == 0 || code_.link(anchor).parent == 0;
  }
  [[nodiscard]] bool is_revolute(int j) const { return code_.link(j).type == JointType::kRevolute; }
  [[nodiscard]] bool has_parallel_child_at_height(int j) const {
    for (int i = 1; i <= code_.size(); ++i) {
      if (code_.link(i).parent == j && is_parallel(i) && !code_.link(i).r.is_zero()) return true;
    }
    return false;
  }

  /// What is nearly always best: a tip's parameters are turned rather than all that moves it, and
  /// the first joints move about one point where they can.
  [[nodiscard]] RneaForm usual_form() const {
    RneaForm form(code_.links.size());
    std::vector<bool> at_base(code_.links.size() + 1, false);  // its origin stands still
    at_base[0] = true;
    for (int j = 1; j <= code_.size(); ++j) {
      LinkForm& link = form[static_cast<std::size_t>(j - 1)];
      if (!is_revolute(j)) continue;
      const int parent = code_.link(j).parent;
      if (is_tip(j) || (is_near_base(j) && parent != 0 && !is_parallel(j))) {
        link.inertia = View::kAxis;
      }
      const std::size_t at = static_cast<std::size_t>(j);
      at_base[at] = at_base[static_cast<std::size_t>(parent)] && code_.link(j).d.is_zero();
      if (is_tip(j) || at_base[at]) link.origin = Origin::kFoot;
    }
    return form;
  }

  /// Changes of the views and of the origin.
  [[nodiscard]] std::vector<LinkForm> changes(const LinkForm& own, int j) const {
    std::vector<LinkForm> result;
    const auto add = [&](auto change) {
      LinkForm form = own;
      change(form);
      result.push_back(form);
    };
    if (is_revolute(j)) {
      if (is_tip(j) || is_near_base(j)) add([](LinkForm& form) { flip(form.inertia); });
      const bool has_height = !code_.link(j).r.is_zero() || own.origin != Origin::kFile;
      if (has_height || code_.link(j).parent > 1) {
        if (own.origin != Origin::kFile) add([](LinkForm& form) { form.origin = Origin::kFile; });
        if (own.origin != Origin::kFoot) add([](LinkForm& form) { form.origin = Origin::kFoot; });
      }
      if (own.origin != Origin::kChild && has_parallel_child_at_height(j)) {
        add([](LinkForm& form) { form.origin = Origin::kChild; });
      }
    }
    if (is_parallel(j)) {
      add([](LinkForm& form) { flip(form.acceleration); });
      add([](LinkForm& form) { flip(form.force); });
      add([](LinkForm& form) { flip(form.moment); });
      add([](LinkForm& form) {
        flip(form.inertia);
        flip(form.force);
      });
    }
    return result;
  }

 private:
  static void flip(View& view) { view = view == View::kLink ? View::kAxis : View::kLink; }

  const CodeModel& code_;
};

/// Everything in the links' own frames, which short chains like.
RneaForm plain_form(const CodeModel& code) {
  LinkForm plain;
  plain.acceleration = plain.moment = View::kLink;
  return RneaForm(code.links.size(), plain);
}

/// @param trace  what stands before the recursion
const RneaForm& choose_form(const Trace& trace, const CodeModel& code) {
  RneaForm& chosen = *code.rnea_form;
  if (!chosen.empty()) return chosen;
  RneaTerms terms;
  terms.rotor = terms.friction = false;
  const auto cost = [&](const RneaForm& form) {
    Trace trial = trace;
    write_rnea(trial, code, terms, form);
    trial.drop_dead_code();
    return trial.count().total();
  };
  const Robot robot(code);
  FormSearch<LinkForm> search(cost, trials(code));
  for (RneaForm form : {robot.usual_form(), plain_form(code)}) {
    search.try_forms(form);
    for (LinkForm& link : form) link.euler_tensor = true;
    search.try_forms(form);
  }
  search.descend([&](const RneaForm& forms, std::size_t at) {
    return robot.changes(forms[at], static_cast<int>(at) + 1);
  });
  search.descend([](const RneaForm& forms, std::size_t at) {
    LinkForm other = forms[at];
    other.euler_tensor = !other.euler_tensor;
    return RneaForm{other};
  });
  chosen = search.best();
  return chosen;
}

}  // namespace

void write_shortest_rnea(Trace& trace, const CodeModel& code, const RneaTerms& terms) {
  write_rnea(trace, code, terms, choose_form(trace, code));
}

}  // namespace dyngen
