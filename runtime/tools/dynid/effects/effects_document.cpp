// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effects_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "gen/effect_file/effect_variables.h"
#include "gen/effect_file/units.h"
#include "runtime/tools/dynid/effects/effect_formula.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/pendulum_signals.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string kind_name(const EffectFile& effect) {
  constexpr const char* kNames[] = {"algebraic", "stateful", "tangent", "alignment"};
  return kNames[static_cast<std::size_t>(effect.kind)];
}
std::string scope_name(const EffectFile& effect) {
  constexpr const char* kNames[] = {"joint", "pair", "robot"};
  return kNames[static_cast<std::size_t>(effect.scope)];
}
std::string role_name(ParameterRole role) {
  constexpr const char* kNames[] = {"linear", "shape", "scanned", "given"};
  return kNames[static_cast<std::size_t>(role)];
}

std::string range_of(const ::dyngen::EffectParameter& parameter) {
  if (!parameter.min && !parameter.max) return "";
  return fmt::format("{} to {}", parameter.min ? spell(*parameter.min) : "any",
                     parameter.max ? spell(*parameter.max) : "any");
}

std::string test_meaning(const std::string& test) {
  for (const auto& [name, meaning] : effect_tests()) {
    if (name == test) return std::string(meaning);
  }
  return {};
}

std::string condition_text(const ::dyngen::EffectCondition& own) {
  return fmt::format("{} <= {}: {}", spell(own.left), spell(own.right), own.text);
}

/// "condition: reason" of all conditions on the name.
std::vector<std::string> demands(const EffectFile& effect) {
  std::vector<std::string> lines;
  for (const auto* conditions : {&effect.requirements, &effect.falsifiers}) {
    for (const auto& own : *conditions) lines.push_back(condition_text(own));
  }
  for (const auto& own : effect.tests) {
    lines.push_back(own.test + ": " + (own.text.empty() ? test_meaning(own.test) : own.text));
  }
  return lines;
}

std::string where_it_runs(const EffectFile& effect) {
  return effect.runs_in_controller() ? "emitted by dyngen" : "not for a controller";
}

/// A cell of a table may not hold a bar.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != text.npos; at = text.find('|', at + 2)) {
    text.insert(at, "\\");
  }
  return text;
}

/// An entry of a list, with its full stop.
std::string entry(const std::string& text) {
  return "- " + text + (text.ends_with('.') ? "\n" : ".\n");
}

std::string markdown_of(const EffectFile& effect) {
  std::string text =
      fmt::format("### {}\n\n{}. Kind: {}; scope: {}; {}.\n", effect.name, effect.title,
                  kind_name(effect), scope_name(effect), where_it_runs(effect));
  if (!effect.source.empty()) text += effect.source + ".\n";
  text += "\n```\n";
  for (const std::string& line : equation_lines(effect)) text += line + "\n";
  text += "```\n\n| parameter | role | unit | bounds | typical | |\n|---|---|---|---|---|---|\n";
  for (const auto& parameter : effect.parameters) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", parameter.name,
                        role_name(parameter.role), unit_text(parameter.unit, JointUnits::kRevolute),
                        range_of(parameter), spell(parameter.typical), cell(parameter.meaning));
  }
  text += "\n" + entry("Visibility: " + effect.hidden) + entry("Experiment: " + effect.separates);
  for (const auto& alias : effect.aliases) {
    const std::string family = alias.family == "base" ? "the base model" : alias.family;
    text += entry("Similar to " + family + ": " + alias.text);
  }
  for (const auto& part : effect.contains) {
    text += entry("Contains " + part.family + ": " + part.text);
  }
  for (const std::string& line : demands(effect)) text += entry("Condition: " + line);
  for (const auto& own : effect.usual) text += entry("Usual: " + condition_text(own));
  return text + "\n";
}

std::string axis_label(const std::string& variable) {
  if (variable == "distance") return "rad since the last reversal";
  if (variable == "t") return "s";
  const ::dyngen::EffectVariable* known = find_effect_variable(variable);
  const std::string unit = known == nullptr ? "" : unit_text(known->unit, JointUnits::kRevolute);
  return variable + (unit.empty() || unit == "1" ? "" : ", " + unit);
}

/// The typical value of a parameter; 0 if there is none of this name.
double value_of(const EffectLaw& law, const VectorXd& typical, const std::string& name) {
  for (int k = 0; k < law.size(); ++k) {
    if (law.parameters[static_cast<std::size_t>(k)].name == name) return typical[k];
  }
  return 0;
}

/// The drawn samples. They lie in the second half, where the initial states have decayed: one
/// stretch after a reversal, a few periods of a ripple, or the whole of a slow signature.
std::vector<Index> shown_samples(const EffectLaw& law, const VectorXd& typical,
                                 const std::string& over, const PendulumRun& run) {
  const Index end = run.time.size();
  Index first = end / 2, step = 30;
  double longest = std::numeric_limits<double>::infinity();
  VectorXd path = VectorXd::Zero(end);
  if (over == "distance") {
    while (first + 1 < end && run.distance[first] <= run.distance[first + 1]) ++first;
    ++first;
    step = 2;
    path = run.distance;
    longest = std::max(0.01, 10 * value_of(law, typical, "zs"));
  } else if (value_of(law, typical, "n") > 2 || value_of(law, typical, "gear") > 0) {
    step = 2;
    const VectorXd q = pendulum_signal("q");
    path = (q.array() - q[first]).abs();
    longest = 0.2;
  }
  std::vector<Index> shown;
  for (Index k = first; k < end && path[k] <= longest; k += step) {
    if (over == "distance" && k > first && path[k] < path[k - step]) break;
    shown.push_back(k);
  }
  return shown;
}

Series signature_of(const EffectFile& effect) {
  const EffectLaw law = effect_law(effect);
  const PendulumRun run = pendulum_run(law);
  const EffectSizes sizes = law.sizes(pendulum_scales());
  VectorXd state = first_states(law, run.variables);
  const VectorXd torque =
      law.evaluate(run.variables, sizes.typical, run.sample_time, state, {}).torque.col(0);
  const std::string over = effect.plot == "frequency" ? "t" : effect.plot;
  const VectorXd x = pendulum_signal(over);
  const std::vector<Index> shown = shown_samples(law, sizes.typical, over, run);
  Series series;
  series.name = effect.name;
  series.x = x(shown);
  series.y = torque(shown);
  return series;
}

}  // namespace

std::string effects_list(const EffectCatalogue& catalogue) {
  std::string text =
      fmt::format("{:<20}{:<27}{:<11}{:<7}{}\n", "family", "effect", "kind", "scope", "");
  std::string family;
  for (const auto& effect : catalogue.all()) {
    text +=
        fmt::format("{:<20}{:<27}{:<11}{:<7}{}\n", effect->family == family ? "" : effect->family,
                    effect->name, kind_name(*effect), scope_name(*effect), effect->title);
    family = effect->family;
  }
  return text;
}

std::string effect_text(const EffectFile& effect) {
  std::string text =
      fmt::format("{} ({}): {}\nkind: {}; scope: {}; {}\n", effect.name, effect.family,
                  effect.title, kind_name(effect), scope_name(effect), where_it_runs(effect));
  if (!effect.source.empty()) text += effect.source + "\n";
  text += "\n";
  for (const std::string& line : equation_lines(effect)) text += "  " + line + "\n";
  text += "\n";
  for (const auto& parameter : effect.parameters) {
    text += fmt::format("  {:<8}{:<9}{:<14}typical {:<18}{}\n", parameter.name,
                        role_name(parameter.role), unit_text(parameter.unit, JointUnits::kRevolute),
                        spell(parameter.typical), parameter.meaning);
  }
  text += "\nvisibility: " + effect.hidden + "\nexperiment: " + effect.separates + "\n";
  for (const auto& alias : effect.aliases) {
    text += fmt::format("similar to {}: {}\n", alias.family, alias.text);
  }
  for (const auto& part : effect.contains) {
    text += fmt::format("contains {}: {}\n", part.family, part.text);
  }
  for (const std::string& line : demands(effect)) text += "condition: " + line + "\n";
  for (const auto& own : effect.usual) text += "usual: " + condition_text(own) + "\n";
  return text;
}

std::string effects_markdown(const EffectCatalogue& catalogue, const std::string& figures) {
  std::string text =
      "# Effects\n\n"
      "`dynid effects --markdown` makes this page from the files in `gen/effects`. The\n"
      "[effect file](effect_file.md) explains their rows. The pictures show the torque of each\n"
      "effect at its typical size, on a pendulum of 10 kg that swings in gravity. A refit of the\n"
      "base model may absorb most of this torque. `dynid atlas` computes the remainder for the\n"
      "motion of a robot ([atlas](../explanation/atlas.md)).\n\n";
  std::string family;
  for (const auto& effect : catalogue.all()) {
    if (effect->family != family) {
      family = effect->family;
      text += "## " + family + "\n\n";
      if (!figures.empty()) text += fmt::format("![{}]({}/{}.svg)\n\n", family, figures, family);
    }
    text += markdown_of(*effect);
  }
  text.pop_back();
  return text;
}

std::vector<FamilyFigure> family_figures(const EffectCatalogue& catalogue) {
  std::vector<FamilyFigure> figures;
  std::map<std::string, std::size_t> panels;  // of the family: by the variable
  for (const auto& effect : catalogue.all()) {
    if (figures.empty() || figures.back().family != effect->family) {
      figures.push_back({effect->family, {}});
      figures.back().figure.panel_width = 560;
      figures.back().figure.panel_height = 260;
      panels.clear();
    }
    Figure& figure = figures.back().figure;
    const std::string over = effect->plot == "frequency" ? "t" : effect->plot;
    const auto [place, added] = panels.emplace(over, figure.panels.size());
    if (added) {
      Panel panel;
      panel.x_label = axis_label(over);
      panel.y_label = "N m";
      figure.panels.push_back(std::move(panel));
    }
    figure.panels[place->second].series.push_back(signature_of(*effect));
  }
  return figures;
}

}  // namespace dyngen::runtime
