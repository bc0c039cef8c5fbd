// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/change_candidates.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "runtime/diagnosis/changes/possible_body.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<std::string_view, kBodyParameters> kBodyNames = {"XX", "XY", "XZ", "YY", "YZ",
                                                                      "ZZ", "MX", "MY", "MZ", "M"};

/// A law that names a change of parameters of the model: it is never evaluated.
EffectLaw law_of(const std::string& family, const std::string& title,
                 std::vector<EffectParameter> parameters) {
  EffectLaw law;
  law.name = law.family = family;
  law.title = title;
  law.parameters = std::move(parameters);
  return law;
}

EffectParameter parameter_of_law(std::string name, std::string unit, std::string meaning) {
  EffectParameter parameter;
  parameter.name = std::move(name);
  parameter.unit = std::move(unit);
  parameter.meaning = std::move(meaning);
  return parameter;
}

/// All at once, each alone, and those before each.
std::vector<std::vector<int>> forms_of(int parameters) {
  std::vector<int> all(static_cast<std::size_t>(parameters));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> forms = {all};
  for (int p = 0; p < parameters && parameters > 1; ++p) {
    forms.push_back({p});
    if (p > 0 && p + 1 < parameters) {
      forms.emplace_back(all.begin(), all.begin() + p + 1);
    }
  }
  return forms;
}

class Candidates {
 public:
  Candidates(const EffectRecordings& data, const std::vector<bool>& later,
             const DiagnosisInput& input)
      : data_(data), later_(later), input_(input), signals_(data), nb_(data.model.size()) {}

  ChangeCandidates run(const std::vector<Hypothesis>& effects, const EffectPoint& point) {
    beta_ = point.beta;
    signals_.set_beta(point.beta);
    signals_.set_tangent_beta(point.beta);
    for (const EffectInstance& effect : point.effects) add_found(effect);
    result_.shared = width_;
    for (const Hypothesis& hypothesis : effects) add_effect(hypothesis);
    for (int j = 0; j < data_.joints(); ++j) add_joint(j);
    add_links();
    for (const LoadPlace& place : input_.loads) add_load(place);
    result_.further = side_by_side(sets_);
    const Index K = nb_ + width_;
    for (std::size_t i = 0; i < result_.all.size(); ++i) {
      ChangeCandidate& own = result_.all[i];
      own.columns = MatrixXd::Zero(K, static_cast<Index>(places_[i].size()));
      for (std::size_t p = 0; p < places_[i].size(); ++p) {
        own.columns(places_[i][p], static_cast<Index>(p)) = 1;
      }
    }
    return std::move(result_);
  }

 private:
  /// @param places  of its parameters among the columns
  ChangeCandidate& add(ChangeCandidate candidate, std::vector<Index> places) {
    if (candidate.families.empty()) candidate.families = {candidate.effect.law.family};
    if (candidate.base.empty()) candidate.base.assign(places.size(), -1);
    if (candidate.parameters.empty()) {
      candidate.parameters.resize(places.size());
      std::iota(candidate.parameters.begin(), candidate.parameters.end(), 0);
    }
    if (candidate.effect.parameters.size() == 0) {
      candidate.effect.parameters = VectorXd::Zero(candidate.effect.law.size());
    }
    result_.all.push_back(std::move(candidate));
    places_.push_back(std::move(places));
    return result_.all.back();
  }

  /// Columns beside the regressor. @return their places
  std::vector<Index> add_columns(JointColumns columns, bool both_sides) {
    if (!both_sides) {
      Index start = 0;
      for (std::size_t run = 0; run < data_.runs.size(); ++run) {
        const Index rows = data_.runs[run].rows.Y.rows();
        for (MatrixXd& part : columns.parts) {
          if (!later_[run]) part.middleRows(start, rows).setZero();
        }
        start += rows;
      }
    }
    std::vector<Index> places(static_cast<std::size_t>(columns.columns()));
    std::iota(places.begin(), places.end(), nb_ + width_);
    width_ += columns.columns();
    sets_.push_back(std::move(columns));
    return places;
  }

  /// An effect of the later recordings: whether the reference has it too is not known.
  void add_found(const EffectInstance& effect) {
    std::vector<int> linear, wanted;
    for (int p = 0; p < effect.law.size(); ++p) {
      if (effect.law.parameters[static_cast<std::size_t>(p)].role != EffectRole::kLinear) continue;
      linear.push_back(p);
      wanted.push_back(1 + p);
    }
    if (linear.empty() || effect.recording >= 0) return;
    try {
      ChangeCandidate candidate;
      candidate.effect = effect;
      candidate.parameters = linear;
      candidate.forms = forms_of(static_cast<int>(linear.size()));
      const std::vector<Index> places =
          add_columns(effect_columns(data_, signals_, effect, wanted, true), true);
      add(std::move(candidate), places);
    } catch (const MissingSignalError&) {
      return;  // the reference lacks what it reads: nothing is known of it there
    }
  }

  void add_effect(const Hypothesis& hypothesis) {
    std::vector<int> wanted;
    for (const int p : hypothesis.linear) wanted.push_back(1 + p);
    try {
      ChangeCandidate candidate;
      candidate.effect = hypothesis.effect;
      candidate.parameters = hypothesis.linear;
      candidate.forms = forms_of(static_cast<int>(wanted.size()));
      set_bounds(candidate);
      const std::vector<Index> places = add_columns(
          effect_columns(data_, signals_, hypothesis.effect, wanted, hypothesis.held), true);
      ChangeCandidate always = candidate;
      always.both_sides = true;
      always.forms = {always.forms.front()};
      add(std::move(candidate), places);
      add(std::move(always), places);
    } catch (const MissingSignalError&) {
      return;
    }
  }

  void set_bounds(ChangeCandidate& candidate) const {
    const EffectInstance& effect = candidate.effect;
    const EffectSizes sizes = effect.law.sizes(scales_of(data_, beta_, effect.joint));
    candidate.least = sizes.min(candidate.parameters);
    candidate.most = sizes.max(candidate.parameters);
  }

  [[nodiscard]] EffectInstance on_joint(EffectLaw law, int joint) const {
    EffectInstance effect;
    effect.law = std::move(law);
    effect.joint = joint;
    effect.link = link_of(joint);
    return effect;
  }

  [[nodiscard]] int link_of(int joint) const {
    for (const EffectInstance& effect : input_.hypotheses) {
      if (effect.joint == joint && effect.link > 0) return effect.link;
    }
    return 0;
  }

  [[nodiscard]] int joint_of_link(int link) const {
    for (const EffectInstance& effect : input_.hypotheses) {
      if (effect.link == link && effect.joint >= 0) return effect.joint;
    }
    return -1;
  }

  void add_joint(int j) {
    const bool turns = data_.model.revolute[static_cast<std::size_t>(j)];
    const std::string torque = turns ? "N m" : "N";
    const int coulomb = parameter_of(data_.model, j, ParameterKind::kCoulomb),
              viscous = parameter_of(data_.model, j, ParameterKind::kViscous);
    ChangeCandidate friction;
    friction.kind = ChangeCandidate::Kind::kFriction;
    std::vector<EffectParameter> parameters;
    std::vector<Index> places;
    if (coulomb >= 0) {
      parameters.push_back(parameter_of_law("Fc", torque, "change of Coulomb friction"));
      places.push_back(coulomb);
    }
    if (viscous >= 0) {
      parameters.push_back(
          parameter_of_law("Fv", turns ? "N m s/rad" : "N s/m", "change of viscous friction"));
      places.push_back(viscous);
    }
    if (!places.empty()) {
      for (const Index place : places) friction.base.push_back(static_cast<int>(place));
      friction.forms = forms_of(static_cast<int>(places.size()));
      friction.effect = on_joint(law_of("friction_change", "Friction that changed", parameters), j);
      friction.formula = coulomb < 0   ? "Fv*qd"
                         : viscous < 0 ? "Fc*sign(qd)"
                                       : "Fc*sign(qd) + Fv*qd";
      add(std::move(friction), places);
    }
    add_single(j, ParameterKind::kOffset, "torque_offset", "Constant torque that changed",
               parameter_of_law("offset", torque, "change of the constant torque"), "offset");
    add_single(j, ParameterKind::kRotorInertia, "rotor_inertia", "Rotor inertia that changed",
               parameter_of_law("J", turns ? "kg m^2" : "kg", "change of the rotor inertia"),
               "J*qdd");
  }

  void add_single(int j, ParameterKind kind, const std::string& family, const std::string& title,
                  EffectParameter parameter, const std::string& formula) {
    const int place = runtime::parameter_of(data_.model, j, kind);
    if (place < 0) return;
    ChangeCandidate candidate;
    candidate.effect = on_joint(law_of(family, title, {std::move(parameter)}), j);
    candidate.base = {place};
    candidate.forms = forms_of(1);
    candidate.formula = formula;
    add(std::move(candidate), {place});
  }

  /// Inertial parameters of each link, as the base parameters have them.
  void add_links() {
    std::map<int, std::vector<int>> links;
    for (int c = 0; c < data_.model.size(); ++c) {
      const LinearParameter& own = data_.model.parameters[static_cast<std::size_t>(c)];
      if (own.kind == ParameterKind::kInertial && own.link > 0) links[own.link].push_back(c);
    }
    for (const auto& [link, columns] : links) {
      std::vector<EffectParameter> parameters;
      for (const int c : columns) {
        const LinearParameter& own = data_.model.parameters[static_cast<std::size_t>(c)];
        parameters.push_back(parameter_of_law(own.name, own.unit, "change of " + own.name));
      }
      ChangeCandidate candidate;
      candidate.kind = ChangeCandidate::Kind::kInertia;
      candidate.effect = on_joint(
          law_of("inertial_change", "Inertial parameters of a link that changed", parameters),
          joint_of_link(link));
      candidate.effect.link = link;
      candidate.base = columns;
      candidate.forms = {forms_of(static_cast<int>(columns.size())).front()};
      candidate.formula = "base parameters of the link";
      add(std::move(candidate), {columns.begin(), columns.end()});
    }
  }

  void add_load(const LoadPlace& place) {
    std::vector<JointColumns> ten;
    std::vector<EffectParameter> parameters;
    for (const std::string_view name : kBodyNames) {
      ten.push_back(load_columns(place.link, "payload_" + std::string(name)));
      const std::string unit = name == "M" ? "kg" : name.front() == 'M' ? "kg m" : "kg m^2";
      parameters.push_back(parameter_of_law(
          std::string(name), unit,
          name == "M"           ? "mass"
          : name.front() == 'M' ? "first moment in the frame of the link"
                                : "element of the inertia tensor about the origin of the frame"));
    }
    ChangeCandidate candidate;
    candidate.kind = ChangeCandidate::Kind::kLoad;
    candidate.effect =
        on_joint(law_of("payload", "Load that was mounted or taken off", parameters), place.joint);
    candidate.effect.link = place.link;
    if (place.joint < 0) candidate.effect.law.scope = EffectScope::kRobot;
    candidate.forms = {forms_of(kBodyParameters).front()};
    candidate.formula = "torque of a body with M, MX .. MZ, XX .. ZZ";
    add(std::move(candidate), add_columns(side_by_side(ten), false));
  }

  /// One parameter of a load on a link, behind the parallel filter.
  JointColumns load_columns(int link, const std::string& name) {
    JointColumns columns;
    for (int j = 0; j < data_.joints(); ++j) {
      columns.joints.push_back(j);
      columns.parts.push_back(MatrixXd::Zero(data_.equations(), 1));
    }
    Index start = 0;
    for (std::size_t run = 0; run < data_.runs.size(); ++run) {
      const EffectRun& own = data_.runs[run];
      const Index rows = own.rows.Y.rows();
      if (later_[run]) {
        const JointMotion motion{own.motion.q, own.motion.dq, own.motion.ddq};
        const TangentColumns& torque = load_torque(run, link, name, motion);
        const MatrixXd filtered = decimate(own.decimator, torque.at({name, link}));
        for (int j = 0; j < data_.joints(); ++j) {
          columns.parts[static_cast<std::size_t>(j)].col(0).segment(start, rows) =
              filtered.col(j).cwiseProduct(own.rows.counted.col(j));
        }
      }
      start += rows;
    }
    return columns;
  }

  /// All ten come together: kept until another link is asked for.
  const TangentColumns& load_torque(std::size_t run, int link, const std::string& name,
                                    const JointMotion& motion) {
    if (link != kept_link_) kept_.clear();
    kept_link_ = link;
    TangentColumns& own = kept_[run];
    if (!own.contains({name, link})) {
      own.merge(data_.robot.tangents({name, link}, motion, VectorXd::Zero(nb_), 0));
    }
    return own;
  }

  const EffectRecordings& data_;
  const std::vector<bool>& later_;
  const DiagnosisInput& input_;
  EffectSignals signals_;
  VectorXd beta_;
  Index nb_, width_ = 0;
  ChangeCandidates result_;
  std::vector<std::vector<Index>> places_;
  std::vector<JointColumns> sets_;
  int kept_link_ = -1;
  std::map<std::size_t, TangentColumns> kept_;
};

}  // namespace

bool is_same_effect(const EffectInstance& a, const EffectInstance& b) {
  return a.law.name == b.law.name && a.joint == b.joint && a.link == b.link && a.other == b.other;
}

ChangeCandidates change_candidates(const EffectRecordings& data, const std::vector<bool>& later,
                                   const DiagnosisInput& input,
                                   const std::vector<Hypothesis>& effects,
                                   const EffectPoint& point) {
  return Candidates(data, later, input).run(effects, point);
}

}  // namespace dyngen::runtime
