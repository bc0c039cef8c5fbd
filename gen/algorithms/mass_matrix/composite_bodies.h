// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <compare>
#include <map>
#include <utility>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/mass_matrix/draft_steps.h"
#include "gen/trace/draft.h"

namespace dyngen {

/// Axes and a point on the way from a link to its parent.
///
/// The transform Rx(alpha) Tx(d) Rz(theta) Tz(r) is passed step by step. Links with parallel axes
/// may also pass over the axes of their chain: those of the frame below the first of them, turned
/// by its alpha only, so that all links of the chain share them.
struct Station {
  enum class Kind {
    kLink,             ///< the link's axes, its origin
    kSlid,             ///< the link's axes, the foot of d on its axis (r taken back)
    kTurned,           ///< axes before theta, the link's origin
    kTurnedSlid,       ///< axes before theta, the foot
    kParent,           ///< the parent's axes, the foot
    kSlidToFirst,      ///< the link's axes, its origin slid to the foot's plane of the first link
    kChain,            ///< the chain's axes, the link's origin
    kChainSlid,        ///< the chain's axes, the foot
    kChainSlidToFirst  ///< the chain's axes, its origin slid to the foot's plane of the first link
  };
  Kind kind = Kind::kLink;
  int link = 0;

  auto operator<=>(const Station&) const = default;
};

/// Ways through the stations.
enum class Route : unsigned char {
  kTurnThenSlide,
  kSlideThenTurn,
  kChain,            ///< over the axes of the chain, if the link's axis is parallel to its parent's
  kChainSlidToFirst  ///< for screws; bodies and wrenches take CompositeChoices::slide_to_first
};

/// The choices that are open in computing M = sum of S^T I S: all give the same numbers, with
/// other numbers of operations. Elements [j] belong to link j.
struct CompositeChoices {
  std::vector<Route> body, wrench, screw;
  std::vector<bool> slide_to_first;  ///< of the first link of a chain
  /// meeting[{i, j}]: where the screw of joint i and the wrench of joint j meet
  std::map<std::pair<int, int>, Station> meeting;
};

/// The robot as drafts see it.
class CompositeRobot {
 public:
  CompositeRobot(DraftLeaves& leaves, const CodeModel& code, const std::vector<LinkFrame>& frames);

  struct Link {
    int parent = 0;
    bool moving = false, revolute = false;
    bool parallel = false;  ///< to the parent's axis
    bool hinge = false;     ///< and both joints are revolute
    int first = 0;          ///< of the chain of parallel axes: itself if it begins one
    int flip = 1;           ///< z along the chain's z
    DraftTurn alpha, theta, chain;
    DraftValue d, r, IA;
    DraftBody own;
  };

  [[nodiscard]] int size() const { return static_cast<int>(links_.size()) - 1; }
  [[nodiscard]] const Link& link(int j) const { return links_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] bool is_ancestor(int i, int j) const;

 private:
  std::vector<Link> links_;
};

/// Writes the mass matrix by composite bodies, from the tips to the base.
///
/// Source of the method: Walker and Orin, "Efficient dynamic computer simulation of robotic
/// mechanisms" (J. Dynamic Systems, Measurement, and Control, 1982). What is ours is the choice of
/// axes and points: unit acceleration of joint j asks a wrench of the composite body j, and
/// its work in the motion of joint i may be taken at any station between the two.
class CompositeDraft {
 public:
  CompositeDraft(Draft& draft, const CompositeRobot& robot, const CompositeChoices& choices);

  /// @param i  @param j  moving links; 0 if neither carries the other
  [[nodiscard]] DraftValue element(int i, int j);

  /// Stations of the wrench of joint j, down to joint i.
  [[nodiscard]] std::vector<Station> stations(int i, int j) const;

 private:
  using Kind = Station::Kind;
  void write_bodies();
  void pass_to_parent(int k);
  DraftBody to_chain(int k, const DraftBody& body);
  [[nodiscard]] Station in_chain(Kind kind, int link) const;
  [[nodiscard]] Station next(const Station& from) const;
  [[nodiscard]] Station source(int j) const;
  [[nodiscard]] bool slides_to_first(int k) const;
  [[nodiscard]] std::size_t meeting(int i, int j) const;
  DraftValue height(int k);
  std::pair<DraftValue, DraftValue> chain_step(int k);
  const DraftWrench& wrench(int j, const Station& at);
  DraftWrench carry(int j, const Station& from, const Station& to);
  const DraftScrew& screw(int i, const Station& at);
  DraftScrew carry_screw(int i, const Station& at);

  Draft& draft_;
  const CompositeRobot& robot_;
  const CompositeChoices& choices_;
  std::vector<DraftBody> body_;        // in the link's frame: own and those merged into it
  std::vector<DraftBody> chain_body_;  // in the chain's axes, where something is merged there
  std::vector<bool> in_chain_axes_;
  std::vector<std::vector<std::pair<Station, DraftWrench>>> wrenches_;  // of joint j, so far
  std::map<std::pair<int, Station>, DraftScrew> screws_;
};

}  // namespace dyngen
