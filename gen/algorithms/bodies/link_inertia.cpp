// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/bodies/link_inertia.h"

#include <fmt/format.h>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

constexpr std::array<const char*, 6> kTensorNames = {"XX", "XY", "XZ", "YY", "YZ", "ZZ"};

bool can_shift(const CodeLink& link) { return link.type == JointType::kRevolute; }

/// Hands a tensor Kzz z z^T (z: the axis of link j) to the links below.
void hand_down(const CodeModel& code, int j, ex Kzz, std::vector<Tensor>& added) {
  while (!Kzz.is_zero() && code.link(j).parent != 0) {
    const CodeLink& link = code.link(j);
    const ex s = exact_sin(link.alpha), c = exact_cos(link.alpha);
    Tensor& J = added[static_cast<std::size_t>(link.parent)];
    if (code.link(link.parent).type != JointType::kRevolute) {
      J[kXX] += Kzz;
      J[kYY] += c * c * Kzz;
      J[kZZ] += s * s * Kzz;
      J[kYZ] += s * c * Kzz;
      return;
    }
    // what the parent does not show either goes on
    J[kXX] += s * s * Kzz;
    J[kZZ] += s * s * Kzz;
    J[kYZ] += s * c * Kzz;
    Kzz *= c * c;
    j = link.parent;
  }
}

}  // namespace

std::vector<ex> origin_shifts(const CodeModel& code, const RneaForm& form) {
  std::vector<ex> shifts(code.links.size() + 1, 0);
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    const std::size_t at = static_cast<std::size_t>(j);
    if (!can_shift(link)) continue;
    switch (form[at - 1].origin) {
      case Origin::kFile:
        break;
      case Origin::kFoot:
        shifts[at] = exact_cos(link.alpha) * shifts[static_cast<std::size_t>(link.parent)] - link.r;
        if (!is_zero_number(GiNaC::sin(link.alpha))) shifts[at] = -link.r;
        break;
      case Origin::kChild:
        for (const CodeLink& child : code.links) {
          if (child.parent != j || !is_zero_number(GiNaC::sin(child.alpha))) continue;
          shifts[at] = exact_cos(child.alpha) * child.r;
          break;
        }
        break;
    }
  }
  return shifts;
}

std::vector<LinkInertia> write_inertia(Trace& trace, const CodeModel& code, const RneaForm& form,
                                       const std::vector<ex>& shifts) {
  std::vector<LinkInertia> result(code.links.size() + 1);
  Tensor nothing;
  nothing.fill(0);
  std::vector<Tensor> added(code.links.size() + 1, nothing);
  for (int j = code.size(); j >= 1; --j) {
    const CodeLink& link = code.link(j);
    const std::size_t at = static_cast<std::size_t>(j);
    LinkInertia& own = result[at];
    const auto chi = [&](Chi kind) { return link.chi[index(kind)]; };
    const auto name = [&](const char* tensor, std::size_t k) {
      return fmt::format("{}{}_{}", tensor, kTensorNames[k], j);
    };
    own.M = chi(Chi::kM);
    own.MS = {chi(Chi::kMX), chi(Chi::kMY), chi(Chi::kMZ)};
    Tensor J = {chi(Chi::kXX), chi(Chi::kXY), chi(Chi::kXZ),
                chi(Chi::kYY), chi(Chi::kYZ), chi(Chi::kZZ)};
    for (std::size_t k = 0; k < 6; ++k) J[k] += added[at][k];
    if (const ex& s = shifts[at]; !s.is_zero()) {  // the origin moves by s along z
      const ex twice = trace.assign(fmt::format("MZ2_{}", j), s * s * own.M - 2 * s * own.MS[2]);
      J[kXX] += twice;
      J[kYY] += twice;
      J[kXZ] += s * own.MS[0];
      J[kYZ] += s * own.MS[1];
      own.MS[2] = trace.assign(fmt::format("MZ_{}", j), own.MS[2] - s * own.M);
    }
    for (std::size_t k = 0; k < 6; ++k) J[k] = trace.assign(name("J", k), J[k]);

    const bool hands_down =
        link.type == JointType::kRevolute &&
        (link.parent == 0 || code.link(link.parent).type == JointType::kRevolute);
    own.euler_tensor = form[at - 1].euler_tensor && hands_down;
    if (!own.euler_tensor) {
      own.tensor = J;
      continue;
    }
    // K = tr(J)/2 I - J, so Kxx + Kyy = ZZ and cyclically
    const ex Kxx = trace.assign(name("K", kXX), (J[kYY] + J[kZZ] - J[kXX]) / 2);
    const ex Kzz = trace.assign(name("K", kZZ), J[kYY] - Kxx);
    own.tensor = {Kxx, -J[kXY], -J[kXZ], trace.assign(name("K", kYY), J[kXX] - Kzz), -J[kYZ], 0};
    hand_down(code, j, Kzz, added);
  }
  return result;
}

LinkInertia turned(Trace& trace, int link, const LinkInertia& inertia,
                   const FrameRotation& rotation) {
  const ex &c = rotation.cos_angle, &s = rotation.sin_angle;
  const auto assign = [&](const std::string& name, const ex& value) {
    return trace.assign(fmt::format("{}_{}", name, link), value);
  };
  const std::string letter = inertia.euler_tensor ? "AK" : "AJ";
  const Tensor& T = inertia.tensor;
  // Txx' = c^2 Txx - 2 s c Txy + s^2 Tyy and so on, with the shared factor
  // s (Txx - Tyy) + 2 c Txy taken out
  const ex shared = assign(
      letter, s * assign(letter + "D", T[kXX] - T[kYY]) + c * assign(letter + "2XY", 2 * T[kXY]));
  const ex turn = assign(letter + "S", s * shared);
  LinkInertia result = inertia;
  result.tensor = {
      assign(letter + "XX", T[kXX] - turn),           assign(letter + "XY", c * shared - T[kXY]),
      assign(letter + "XZ", c * T[kXZ] - s * T[kYZ]), assign(letter + "YY", T[kYY] + turn),
      assign(letter + "YZ", s * T[kXZ] + c * T[kYZ]), T[kZZ]};
  result.MS = {assign("AMX", c * inertia.MS[0] - s * inertia.MS[1]),
               assign("AMY", s * inertia.MS[0] + c * inertia.MS[1]), inertia.MS[2]};
  return result;
}

}  // namespace dyngen
