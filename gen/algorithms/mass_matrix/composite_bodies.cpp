// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/mass_matrix/composite_bodies.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/diagnostic/assert.h"

namespace dyngen {
namespace {

constexpr std::array<const char*, kInertialCount> kCompositeNames = {
    "XXC", "XYC", "XZC", "YYC", "YZC", "ZZC", "MXC", "MYC", "MZC", "MC"};
constexpr std::array<const char*, kInertialCount> kChainNames = {"XXK", "XYK", "XZK", "YYK", "YZK",
                                                                 "ZZK", "MXK", "MYK", "MZK", "MK"};

void assign_body(Draft& draft, const std::array<const char*, kInertialCount>& names, int link,
                 DraftBody& body) {
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    body.chi[k] = draft.assign({names[k], 0, link, 0}, body.chi[k]);
  }
}

/// Partial sums get statements where many links hang on one.
void add_body(Draft& draft, int link, DraftBody& sum, const DraftBody& body) {
  constexpr std::size_t kTerms = 4;
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    sum.chi[k] += body.chi[k];
    if (sum.chi[k].terms().size() < kTerms) continue;
    sum.chi[k] = draft.assign({kCompositeNames[k], 0, link, 0}, sum.chi[k]);
  }
}

/// A turn about x by 0 or pi.
DraftTurn half_turn(int flip) { return {0, flip}; }

DraftWrench times(int sign, const DraftWrench& w) {
  return sign > 0 ? w
                  : DraftWrench{{-w.force[0], -w.force[1], -w.force[2]},
                                {-w.moment[0], -w.moment[1], -w.moment[2]}};
}

}  // namespace

CompositeRobot::CompositeRobot(DraftLeaves& leaves, const CodeModel& code,
                               const std::vector<LinkFrame>& frames) {
  links_.resize(code.links.size() + 1);
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& from = code.link(j);
    const LinkFrame& frame = frames[static_cast<std::size_t>(j)];
    Link& link = links_[static_cast<std::size_t>(j)];
    const auto leaf = [&](const char* name, const GiNaC::ex& value) {
      return leaves.add(fmt::format("{}_{}", name, j), value);
    };
    link.parent = from.parent;
    link.moving = from.coordinate >= 0;
    link.revolute = from.type == JointType::kRevolute;
    link.parallel = frame.parallel;
    link.first = frame.parallel ? links_[static_cast<std::size_t>(from.parent)].first : j;
    if (frame.parallel) {
      const Link& parent = links_[static_cast<std::size_t>(from.parent)];
      link.flip = parent.flip * (frame.z_sign.is_equal(1) ? 1 : -1);
      link.hinge = link.revolute && parent.revolute;
    }
    link.alpha = {leaf("SA", frame.rotation.sin_alpha), leaf("CA", frame.rotation.cos_alpha)};
    link.theta = {leaf("S", frame.rotation.sin_angle), leaf("C", frame.rotation.cos_angle)};
    link.chain = {leaf("SK", frame.from_anchor.sin_angle), leaf("CK", frame.from_anchor.cos_angle)};
    link.d = leaf("d", from.d);
    link.r = leaf("R", from.type == JointType::kPrismatic ? from.r + from.q : from.r);
    link.IA = link.moving ? leaf("IA", from.chi[index(Chi::kIA)]) : DraftValue(0);
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      link.own.chi[k] = leaf(std::string(kChiNames[k]).c_str(), from.chi[k]);
    }
  }
}

bool CompositeRobot::is_ancestor(int i, int j) const {
  while (j > i) j = link(j).parent;
  return i == j;
}

CompositeDraft::CompositeDraft(Draft& draft, const CompositeRobot& robot,
                               const CompositeChoices& choices)
    : draft_(draft), robot_(robot), choices_(choices) {
  const std::size_t count = static_cast<std::size_t>(robot.size()) + 1;
  body_.resize(count);
  chain_body_.resize(count);
  in_chain_axes_.resize(count);
  wrenches_.resize(count);
  write_bodies();
}

// ---- bodies ----

void CompositeDraft::write_bodies() {
  for (int j = 1; j <= robot_.size(); ++j) {
    body_[static_cast<std::size_t>(j)] = robot_.link(j).own;
  }
  for (int k = robot_.size(); k >= 1; --k) {
    draft_.section("tensor and first moments of link ", k, " and the links it carries");
    assign_body(draft_, kCompositeNames, k, body_[static_cast<std::size_t>(k)]);
    pass_to_parent(k);
  }
}

bool CompositeDraft::slides_to_first(int k) const {
  return choices_.slide_to_first[static_cast<std::size_t>(robot_.link(k).first)];
}

/// The body of link k in the chain's axes; its point slid to the first foot's plane or not.
DraftBody CompositeDraft::to_chain(int k, const DraftBody& body) {
  const CompositeRobot::Link& link = robot_.link(k);
  const DraftOwner owner{k, 0};
  const DraftBody slid = slides_to_first(k) ? slide_z(draft_, owner, height(k), body) : body;
  return turn_x(draft_, owner, half_turn(link.flip), turn_z(draft_, owner, link.chain, slid));
}

void CompositeDraft::pass_to_parent(int k) {
  const auto at = static_cast<std::size_t>(k);
  const CompositeRobot::Link& link = robot_.link(k);
  const DraftOwner owner{k, 0};
  const bool others_in_chain = in_chain_axes_[at];
  const bool over_chain = link.parallel && (others_in_chain || choices_.body[at] == Route::kChain);
  DraftBody body;
  if (over_chain || others_in_chain) {
    DraftBody& chain = chain_body_[at];
    add_body(draft_, k, chain, to_chain(k, body_[at]));
    assign_body(draft_, kChainNames, k, chain);
    body = slides_to_first(k) ? chain : slide_z(draft_, owner, link.flip * link.r, chain);
  }
  if (link.parent == 0) return;
  const auto parent = static_cast<std::size_t>(link.parent);
  if (over_chain) {
    const auto [x, y] = chain_step(k);
    add_body(draft_, link.parent, chain_body_[parent],
             slide_xy(draft_, owner, x, y, link.hinge, body));
    in_chain_axes_[parent] = true;
    return;
  }
  if (!others_in_chain) {
    body = choices_.body[at] == Route::kSlideThenTurn
               ? turn_z(draft_, owner, link.theta, slide_z(draft_, owner, link.r, body_[at]))
               : slide_z(draft_, owner, link.r, turn_z(draft_, owner, link.theta, body_[at]));
  }
  body = turn_x(draft_, owner, link.alpha, body);
  add_body(draft_, link.parent, body_[parent],
           slide_xy(draft_, owner, link.d, 0, link.hinge, body));
}

/// Of the link's origin above the foot's plane of the chain's first link, along the own z.
DraftValue CompositeDraft::height(int k) {
  const CompositeRobot::Link& link = robot_.link(k);
  if (!link.parallel) return link.r;
  const int turned_over = link.flip * robot_.link(link.parent).flip;
  return draft_.assign({"H", 0, k, 0}, link.r + turned_over * height(link.parent));
}

/// From the parent's origin to the link's foot, in the chain's axes.
std::pair<DraftValue, DraftValue> CompositeDraft::chain_step(int k) {
  const CompositeRobot::Link& link = robot_.link(k);
  const CompositeRobot::Link& parent = robot_.link(link.parent);
  return {draft_.assign({"PX", 0, k, 0}, link.d * parent.chain.cos),
          draft_.assign({"PY", 0, k, 0}, parent.flip * link.d * parent.chain.sin)};
}

// ---- stations ----

/// The chain's axes of its first link are those before its own turn.
Station CompositeDraft::in_chain(Kind kind, int link) const {
  if (robot_.link(link).first == link) {
    return {kind == Kind::kChain ? Kind::kTurned : Kind::kTurnedSlid, link};
  }
  return {kind, link};
}

/// Where the wrench goes from here. Link 0: nowhere.
Station CompositeDraft::next(const Station& from) const {
  const int k = from.link;
  const CompositeRobot::Link& link = robot_.link(k);
  switch (from.kind) {
    case Kind::kLink: {
      const Route route = choices_.wrench[static_cast<std::size_t>(k)];
      if (route == Route::kChain && link.parallel) {
        return {slides_to_first(k) ? Kind::kSlidToFirst : Kind::kChain, k};
      }
      return {route == Route::kSlideThenTurn ? Kind::kSlid : Kind::kTurned, k};
    }
    case Kind::kSlid:
    case Kind::kTurned:
      return {Kind::kTurnedSlid, k};
    case Kind::kTurnedSlid:
      return link.parent == 0 ? Station{} : Station{Kind::kParent, k};
    case Kind::kParent:
      return {Kind::kLink, link.parent};
    case Kind::kSlidToFirst:
      return {Kind::kChainSlidToFirst, k};
    case Kind::kChain:
      return {Kind::kChainSlid, k};
    case Kind::kChainSlid:
      return in_chain(Kind::kChain, link.parent);
    case Kind::kChainSlidToFirst:
      return in_chain(Kind::kChainSlidToFirst, link.parent);
  }
  return {};
}

/// Where the whole composite body is known first.
Station CompositeDraft::source(int j) const {
  if (!in_chain_axes_[static_cast<std::size_t>(j)]) return {Kind::kLink, j};
  return in_chain(slides_to_first(j) ? Kind::kChainSlidToFirst : Kind::kChain, j);
}

std::vector<Station> CompositeDraft::stations(int i, int j) const {
  std::vector<Station> result;
  for (Station at = source(j); at.link >= i; at = next(at)) {
    if (at.link == 0 || (at.link == i && at.kind == Kind::kParent)) break;
    result.push_back(at);
  }
  return result;
}

/// The chosen station, or the next one of its link, or the first one of joint i itself.
std::size_t CompositeDraft::meeting(int i, int j) const {
  const std::vector<Station> path = stations(i, j);
  std::size_t fallback = 0;
  while (path[fallback].link != i) ++fallback;
  const auto chosen = choices_.meeting.find({i, j});
  if (chosen == choices_.meeting.end()) return fallback;
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (path[at] == chosen->second) return at;
  }
  return fallback;
}

DraftValue CompositeDraft::element(int i, int j) {
  if (i > j) std::swap(i, j);
  if (!robot_.is_ancestor(i, j)) return 0;
  const Station at = stations(i, j)[meeting(i, j)];
  const DraftWrench& effort = wrench(j, at);
  return draft_.assign({"M", 0, i, j}, work(screw(i, at), effort));
}

// ---- wrenches ----

const DraftWrench& CompositeDraft::wrench(int j, const Station& at) {
  auto& known = wrenches_[static_cast<std::size_t>(j)];
  if (known.empty()) {
    const auto own = static_cast<std::size_t>(j);
    const CompositeRobot::Link& link = robot_.link(j);
    const Station first = source(j);
    const DraftWrench unit = in_chain_axes_[own]
                                 ? times(link.flip, unit_wrench(chain_body_[own], link.revolute))
                                 : unit_wrench(body_[own], link.revolute);
    known.emplace_back(first, unit);
  }
  for (std::size_t i = 0;; ++i) {
    if (known[i].first == at) return known[i].second;
    if (i + 1 < known.size()) continue;
    const Station from = known.back().first;
    const Station to = next(from);
    DYNGEN_ASSERT(to.link > 0, "the stations of a wrench lead to every joint that carries it");
    known.emplace_back(to, carry(j, from, to));
  }
}

DraftWrench CompositeDraft::carry(int j, const Station& from, const Station& to) {
  const int k = from.link;
  const CompositeRobot::Link& link = robot_.link(k);
  const DraftOwner owner{j, k};
  DraftWrench w = wrench(j, from);
  switch (from.kind) {
    case Kind::kLink:
      if (to.kind == Kind::kSlid) return slide_z(draft_, owner, link.r, w);
      if (to.kind == Kind::kSlidToFirst) return slide_z(draft_, owner, height(k), w);
      if (to.kind == Kind::kTurned) return turn_z(draft_, owner, link.theta, w);
      [[fallthrough]];
    case Kind::kSlidToFirst:
      return turn_x(draft_, owner, half_turn(link.flip), turn_z(draft_, owner, link.chain, w));
    case Kind::kSlid:
      return turn_z(draft_, owner, link.theta, w);
    case Kind::kTurned:
      return slide_z(draft_, owner, link.r, w);
    case Kind::kTurnedSlid:
      return turn_x(draft_, owner, link.alpha, w);
    case Kind::kParent:
      return slide_xy(draft_, owner, link.d, 0, w);
    case Kind::kChain:
      return slide_z(draft_, owner, link.flip * link.r, w);
    case Kind::kChainSlid:
    case Kind::kChainSlidToFirst: {
      const auto [x, y] = chain_step(k);
      return slide_xy(draft_, owner, x, y, w);
    }
  }
  return w;
}

// ---- screws ----

const DraftScrew& CompositeDraft::screw(int i, const Station& at) {
  const auto key = std::pair(i, at);
  if (const auto known = screws_.find(key); known != screws_.end()) return known->second;
  return screws_[key] = carry_screw(i, at);
}

DraftScrew CompositeDraft::carry_screw(int i, const Station& at) {
  const int k = at.link;
  const CompositeRobot::Link& link = robot_.link(k);
  const DraftOwner owner{i, k};
  if (k == i) {  // moving along or turning about z changes nothing
    const bool chain_axes = at.kind == Kind::kChain || at.kind == Kind::kChainSlid ||
                            at.kind == Kind::kChainSlidToFirst;
    const DraftVector z = {0, 0, chain_axes ? link.flip : 1};
    const DraftVector none = {0, 0, 0};
    return link.revolute ? DraftScrew{z, none} : DraftScrew{none, z};
  }
  const auto from = [&](Kind kind, int where) { return screw(i, {kind, where}); };
  const auto from_chain = [&](Kind kind, int where) { return screw(i, in_chain(kind, where)); };
  switch (at.kind) {
    case Kind::kLink:
      switch (choices_.screw[static_cast<std::size_t>(k)]) {
        case Route::kSlideThenTurn:
          return slide_z(draft_, owner, link.r, from(Kind::kSlid, k));
        case Route::kChainSlidToFirst:
          if (!link.parallel) break;
          return slide_z(draft_, owner, height(k), from(Kind::kSlidToFirst, k));
        case Route::kChain:
          if (!link.parallel) break;
          return turn_z(draft_, owner, link.chain,
                        turn_x(draft_, owner, half_turn(link.flip), from_chain(Kind::kChain, k)));
        default:
          break;
      }
      return turn_z(draft_, owner, link.theta, from(Kind::kTurned, k));
    case Kind::kSlid:
      return turn_z(draft_, owner, link.theta, from(Kind::kTurnedSlid, k));
    case Kind::kTurned:
      return slide_z(draft_, owner, link.r, from(Kind::kTurnedSlid, k));
    case Kind::kTurnedSlid:
      return turn_x(draft_, owner, link.alpha, from(Kind::kParent, k));
    case Kind::kParent:
      return slide_xy(draft_, owner, link.d, 0, from(Kind::kLink, link.parent));
    case Kind::kSlidToFirst:
      return turn_z(
          draft_, owner, link.chain,
          turn_x(draft_, owner, half_turn(link.flip), from_chain(Kind::kChainSlidToFirst, k)));
    case Kind::kChain:
      return slide_z(draft_, owner, link.flip * link.r, from(Kind::kChainSlid, k));
    case Kind::kChainSlid: {
      const auto [x, y] = chain_step(k);
      return slide_xy(draft_, owner, x, y, from_chain(Kind::kChain, link.parent));
    }
    case Kind::kChainSlidToFirst: {
      const auto [x, y] = chain_step(k);
      return slide_xy(draft_, owner, x, y, from_chain(Kind::kChainSlidToFirst, link.parent));
    }
  }
  return {};
}

}  // namespace dyngen
