// SPDX-License-Identifier: MIT
#include "tests/baselines/friction_ladder.h"

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <limits>

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kSpeeds = {0.02, 0.05, 0.1, 0.2};  // of the fast one
constexpr std::array kWays = {0.0005, 0.002, 0.008};    // of the reach

double sign(double v) { return static_cast<double>((v > 0) - (v < 0)); }

}  // namespace

std::string family_of(const FrictionTerm& term) {
  switch (term.kind) {
    case FrictionKind::kAsymmetric:
      return "asymmetric_viscous";
    case FrictionKind::kStribeck:
      return "stribeck";
    case FrictionKind::kCubic:
      return "nonlinear_viscous";
    case FrictionKind::kPresliding:
      return "presliding";
  }
  return "";
}

VectorXd friction_column(const FrictionTerm& term, const VectorXd& dq, double sample_time) {
  VectorXd column(dq.size());
  double z = 0;
  for (Index k = 0; k < dq.size(); ++k) {
    const double v = dq[k];
    switch (term.kind) {
      case FrictionKind::kAsymmetric:
        column[k] = std::abs(v);
        break;
      case FrictionKind::kStribeck:
        column[k] = sign(v) * std::exp(-v * v / (term.shape * term.shape));
        break;
      case FrictionKind::kCubic:
        column[k] = v * v * v;
        break;
      case FrictionKind::kPresliding:
        // exact for the speed of this sample
        z = sign(v) + (z - sign(v)) * std::exp(-std::abs(v) * sample_time / term.shape);
        column[k] = z - sign(v);
        break;
    }
  }
  return column;
}

std::vector<std::vector<FrictionTerm>> friction_ladder(double fast, double reach) {
  std::vector<std::vector<FrictionTerm>> rungs = {{}, {{FrictionKind::kAsymmetric, 0}}};
  std::vector<std::vector<FrictionTerm>> highest;
  for (const double speed : kSpeeds) {
    rungs.push_back({rungs[1].front(), {FrictionKind::kStribeck, speed * fast}});
    highest.push_back(rungs.back());
    highest.back().push_back({FrictionKind::kCubic, 0});
    for (const double way : kWays) {
      highest.push_back(rungs.back());
      highest.back().push_back({FrictionKind::kPresliding, way * reach});
    }
  }
  rungs.insert(rungs.end(), highest.begin(), highest.end());
  return rungs;
}

std::size_t best_rung(const std::vector<MatrixXd>& fitted, const VectorXd& left,
                      const std::vector<MatrixXd>& checked, const VectorXd& checked_left) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t rung = 0; rung < fitted.size(); ++rung) {
    VectorXd rest = checked_left;
    if (fitted[rung].cols() > 0) {
      rest -= checked[rung] * fitted[rung].colPivHouseholderQr().solve(left);
    }
    if (!(rest.squaredNorm() < least)) continue;
    least = rest.squaredNorm();
    best = rung;
  }
  return best;
}

}  // namespace dyngen::test
