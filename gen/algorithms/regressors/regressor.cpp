// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/regressors/regressor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/kinematics/joint_screws.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/algorithms/kinematics/origin_slides.h"
#include "gen/algorithms/regressors/link_regressor.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Columns of the regressor: parameters, then zeros up to the width.
struct Columns {
  const std::vector<Column>& parameters;
  std::size_t width;
};

/// What one joint's drive adds to its own row.
ex drive_entry(const CodeLink& link, Chi kind) {
  switch (kind) {
    case Chi::kIA:
      return link.ddq;
    case Chi::kFV:
      return link.dq;
    case Chi::kFS:
      return GiNaC::csgn(link.dq);
    default:
      return 1;
  }
}

/// A link, and a center of joints that carry it.
using LinkCenter = std::pair<int, int>;

/// What may be chosen: it changes the number of operations, not the values.
struct Plan {
  OriginSlides slides;
  std::set<LinkCenter> about_center{};  ///< first moments act by their moment about the center
  std::set<int> force_below{};          ///< links whose forces are turned into the frame below
};

/// What there is to choose.
struct Choices {
  std::vector<LinkCenter> centers;  ///< several joints turn about it, away from the link's origin
  std::vector<int> leaves;          ///< no link hangs on it
};

class RegressorWriter {
 public:
  RegressorWriter(Trace& trace, const CodeModel& code, const Columns& columns, const Plan& plan)
      : trace_(trace), code_(code), columns_(columns), plan_(plan) {}

  void write() {
    std::vector<LinkFrame> frames = write_frames(trace_, code_);
    slide_origins(trace_, code_, plan_.slides, frames);
    const std::vector<LinkMotion> motions = write_motion(trace_, code_, frames, MotionTerms{});
    const std::vector<LinkScrews> screws = write_joint_screws(trace_, code_, frames);
    std::vector<CarriedLink> links(code_.links.size() + 1);
    links[0].stands = true;
    rows_.resize(links.size());
    std::set<int> along_gravity;
    for (int j = 1; j <= code_.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const auto anchor = static_cast<std::size_t>(frames[at].anchor);
      const CodeLink& link = code_.link(j);
      CarriedLink& own = links[at];
      const bool shares_origin = link.type != JointType::kPrismatic && is_zero(frames[at].P);
      own.stands = link.parent == 0
                       ? link.type != JointType::kPrismatic
                       : links[static_cast<std::size_t>(link.parent)].stands && shares_origin;
      const Vector3& VP = motions[at].VP;
      if (own.stands && VP[0].is_zero() && VP[1].is_zero()) along_gravity.insert(j);
      own.link = j;
      own.motion = &motions[at];
      own.screws = &screws[at];
      own.frame = &frames[at];
      own.anchor_motion = &motions[anchor];
      own.anchor_screws = &screws[anchor];
      own.along_gravity = along_gravity;
      apply_plan(own);
      write_link(own);
    }
    write_output();
  }

  [[nodiscard]] const Choices& choices() const { return choices_; }

 private:
  void apply_plan(CarriedLink& own) {
    const auto& joints = own.screws->joints;
    for (const auto& entry : own.screws->centers) {
      const int center = entry.first;
      const Vector3& to_origin = entry.second;
      const auto turns = std::count_if(joints.begin(), joints.end(), [&](const JointScrew& screw) {
        return screw.leads() && screw.center == center;
      });
      if (turns > 1 && !is_zero(to_origin)) choices_.centers.emplace_back(own.link, center);
      if (plan_.about_center.contains({own.link, center})) own.about_center.insert(center);
    }
    own.force_below = plan_.force_below.contains(own.link);
    const bool leaf = std::none_of(code_.links.begin(), code_.links.end(),
                                   [&](const CodeLink& link) { return link.parent == own.link; });
    if (leaf && !own.frame->parallel) choices_.leaves.push_back(own.link);
  }

  void write_link(CarriedLink& own) {
    const ex& slide = plan_.slides[static_cast<std::size_t>(own.link)];
    for (const Column& column : columns_.parameters) {
      if (column.link != own.link || index(column.kind) >= kInertialCount) continue;
      own.wanted[index(column.kind)] = true;
      if (slide.is_zero()) continue;
      if (column.kind == Chi::kMX) own.wanted[index(Chi::kXZ)] = true;
      if (column.kind == Chi::kMY) own.wanted[index(Chi::kYZ)] = true;
    }
    trace_.section(
        fmt::format("link {}: torque of the joints that carry it, per unit parameter", own.link));
    auto& rows = rows_[static_cast<std::size_t>(own.link)];
    rows = write_link_regressor(trace_, own);
    if (slide.is_zero()) return;
    for (auto& entry : rows) {
      const int joint = entry.first;
      InertialRow& row = entry.second;
      const auto back = [&](Chi first, Chi product) {
        const std::string name = fmt::format("Y{}_{}{}", joint, kChiNames[index(first)], own.link);
        row[index(first)] = trace_.assign(name, row[index(first)] - slide * row[index(product)]);
      };
      back(Chi::kMX, Chi::kXZ);
      back(Chi::kMY, Chi::kYZ);
    }
  }

  [[nodiscard]] ex entry(const Column& column, int joint) const {
    if (index(column.kind) >= kInertialCount) {
      return column.link == joint ? drive_entry(code_.link(joint), column.kind) : ex(0);
    }
    const auto& rows = rows_[static_cast<std::size_t>(column.link)];
    const auto row = rows.find(joint);
    return row == rows.end() ? ex(0) : row->second[index(column.kind)];
  }

  void write_output() {
    trace_.section("regressor");
    const int width = static_cast<int>(columns_.width);
    for (int j = 1; j <= code_.size(); ++j) {
      const int row = code_.link(j).coordinate;
      if (row < 0) continue;
      for (int c = 0; c < width; ++c) {
        const auto at = static_cast<std::size_t>(c);
        const bool parameter = at < columns_.parameters.size();
        trace_.output("Y", row * width + c, parameter ? entry(columns_.parameters[at], j) : ex(0));
      }
    }
  }

  Trace& trace_;
  const CodeModel& code_;
  const Columns& columns_;
  const Plan& plan_;
  std::vector<std::map<int, InertialRow>> rows_;  // of each link, by joint
  Choices choices_;
};

/// Finds a plan with few operations by trials.
class Planner {
 public:
  Planner(const CodeModel& code, const Columns& columns) : code_(code), columns_(columns) {}

  Plan find() {
    const std::vector<bool> may_slide = links_that_may_slide(code_, columns_.parameters);
    plan_.slides = choose_slides(
        code_, may_slide, [&](const OriginSlides& trial) { return count({.slides = trial}); });
    if (code_.size() > kMostLinks) return plan_;
    least_ = count(plan_);
    // centers and leaves from the tips to the base: what a link needs, those below it must carry
    const Choices choices = choices_;
    std::set<int> centers;
    for (const auto& [link, center] : choices.centers) centers.insert(center);
    for (const int center : centers) {
      Plan trial = plan_;
      for (auto choice = choices.centers.rbegin(); choice != choices.centers.rend(); ++choice) {
        if (choice->second != center) continue;
        trial.about_center.insert(*choice);
        keep_if_better(trial);
      }
    }
    for (const int leaf : choices.leaves) {
      Plan trial = plan_;
      trial.force_below.insert(leaf);
      keep_if_better(trial);
    }
    return plan_;
  }

 private:
  /// Each trial writes the whole function: not for robots where that takes long.
  static constexpr int kMostLinks = 12;

  int count(const Plan& plan) {
    Trace scratch(&code_.inputs);
    RegressorWriter writer(scratch, code_, columns_, plan);
    writer.write();
    scratch.drop_dead_code();
    choices_ = writer.choices();
    return scratch.count().total();
  }
  void keep_if_better(const Plan& trial) {
    const int own = count(trial);
    if (own >= least_) return;
    least_ = own;
    plan_ = trial;
  }

  const CodeModel& code_;
  const Columns& columns_;
  Plan plan_;
  int least_ = 0;
  Choices choices_;
};

void write_columns(Trace& trace, const CodeModel& code, const Columns& columns) {
  const Plan plan = Planner(code, columns).find();
  RegressorWriter(trace, code, columns, plan).write();
}

}  // namespace

void write_regressor(Trace& trace, const CodeModel& code) {
  write_columns(trace, code, {code.chi_columns, code.chi.size()});
}

void write_base_regressor(Trace& trace, const CodeModel& code) {
  write_columns(trace, code, {code.beta_columns, code.beta.size()});
}

}  // namespace dyngen
