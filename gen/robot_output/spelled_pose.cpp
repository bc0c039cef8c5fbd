// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_output/spelled_pose.h"

#include <algorithm>
#include <cmath>

#include "gen/bodies/body_tree.h"
#include "gen/bodies/decimal.h"

namespace dyngen {

Vector3 rpy_of(const Matrix3& R) {
  const Real level = std::hypot(R[0][0], R[1][0]);  // cosine of the pitch
  const Real pitch = std::atan2(-R[2][0], level);
  Vector3 rpy;
  constexpr Real kUpright = 1e-15L;  // below, roll and yaw turn about one axis
  if (level < kUpright) {
    rpy = {{0, pitch, std::atan2(-R[0][1], R[1][1])}};
  } else {
    rpy = {{std::atan2(R[2][1], R[2][2]), pitch, std::atan2(R[1][0], R[0][0])}};
  }
  for (Real& angle : rpy.at) angle = rounded_angle(angle, kSameAngle / 1000);
  return rpy;
}

std::array<Real, 4> quaternion_of(const Matrix3& R) {
  // the largest of the four squares first (Shepperd 1978)
  const Real trace = R[0][0] + R[1][1] + R[2][2];
  const std::array<Real, 4> squares = {trace, R[0][0], R[1][1], R[2][2]};
  const auto largest =
      static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  std::array<Real, 4> q{};
  if (largest == 0) {
    q = {1 + trace, R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};
  } else {
    const std::size_t i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    q[0] = R[k][j] - R[j][k];
    q[1 + i] = 1 + R[i][i] - R[j][j] - R[k][k];
    q[1 + j] = R[j][i] + R[i][j];
    q[1 + k] = R[k][i] + R[i][k];
  }
  const Real length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Real& value : q) value = (q[0] < 0 ? -value : value) / length;
  return q;
}

std::string spelled_vector(const Vector3& v) {
  constexpr Real kRounding = 1e-16L;
  const Real size = norm(v);
  std::string text;
  for (const Real value : v.at) {
    text +=
        (text.empty() ? "" : " ") + exact_decimal(std::fabs(value) <= kRounding * size ? 0 : value);
  }
  return text;
}

}  // namespace dyngen
