// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/origin_slides.h"

#include <fmt/format.h>

#include <cstddef>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Each trial writes a whole function: not for robots where that takes long.
constexpr int kMostTrials = 8;

OriginSlides slides_of(const CodeModel& code, const std::vector<bool>& chosen) {
  OriginSlides slides(chosen.size(), 0);
  for (int j = 1; j <= code.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const CodeLink& link = code.link(j);
    if (!chosen[at]) continue;
    slides[at] = link.r;
    const bool parallel = link.parent != 0 && exact_sin(link.alpha).is_zero();
    if (parallel) {
      slides[at] += exact_cos(link.alpha) * slides[static_cast<std::size_t>(link.parent)];
    }
  }
  return slides;
}

}  // namespace

void slide_origins(Trace& trace, const CodeModel& code, const OriginSlides& slides,
                   std::vector<LinkFrame>& frames) {
  for (int j = 1; j <= code.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    LinkFrame& frame = frames[at];
    const ex& own = slides[at];
    const ex& below = slides[static_cast<std::size_t>(code.link(j).parent)];
    if (own.is_zero() && below.is_zero()) continue;
    frame.P[1] =
        trace.assign(fmt::format("PS2_{}", j), frame.P[1] + own * frame.rotation.sin_alpha);
    frame.P[2] =
        trace.assign(fmt::format("PS3_{}", j), frame.P[2] - own * frame.rotation.cos_alpha + below);
  }
}

std::vector<bool> links_that_may_slide(const CodeModel& code, const std::vector<Column>& columns) {
  std::vector<bool> may_slide(code.links.size() + 1, true);
  for (const Column& column : columns) {
    if (column.kind == Chi::kMZ || column.kind == Chi::kM) {
      may_slide[static_cast<std::size_t>(column.link)] = false;
    }
  }
  return may_slide;
}

OriginSlides choose_slides(const CodeModel& code, const std::vector<bool>& may_slide,
                           const std::function<int(const OriginSlides&)>& count) {
  std::vector<bool> chosen(may_slide.size(), false);
  std::vector<std::size_t> candidates;
  for (int j = 1; j <= code.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const CodeLink& link = code.link(j);
    if (may_slide[at] && link.type == JointType::kRevolute && link.parent != 0 &&
        !link.r.is_zero()) {
      candidates.push_back(at);
    }
  }
  OriginSlides best = slides_of(code, chosen);
  if (candidates.empty() || candidates.size() > kMostTrials) return best;
  int least = count(best);
  for (const std::size_t j : candidates) {
    chosen[j] = true;
    const OriginSlides slides = slides_of(code, chosen);
    const int own = count(slides);
    chosen[j] = own < least;
    if (!chosen[j]) continue;
    least = own;
    best = slides;
  }
  return best;
}

}  // namespace dyngen
