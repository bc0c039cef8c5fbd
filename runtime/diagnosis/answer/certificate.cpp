// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/certificate.h"

#include <cmath>
#include <limits>
#include <utility>

namespace dyngen::runtime {
namespace {

constexpr double kLeastLeft = 1e-6;  // of an effect's chi-square beside the model

}  // namespace

std::vector<CertificateLine> certificate_of(const std::vector<Hypothesis>& hypotheses,
                                            const CompetitionResult& result, double detectable) {
  std::vector<CertificateLine> lines;
  for (const NamedResult& named : result.last.named) {
    if (is_winner(result, named.hypothesis) || named.typical.size() == 0) continue;
    const Hypothesis& hypothesis = hypotheses[named.hypothesis];
    Eigen::Index main = 0;
    named.typical.cwiseAbs().maxCoeff(&main);
    CertificateLine line;
    line.effect = hypothesis.effect;
    line.parameter = hypothesis.linear[static_cast<std::size_t>(main)];
    line.smallest =
        named.typical_lambda > 0 && named.part_left > kLeastLeft
            ? std::abs(named.typical[main]) * std::sqrt(detectable / named.typical_lambda)
            : std::numeric_limits<double>::infinity();
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace dyngen::runtime
