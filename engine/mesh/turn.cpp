// SPDX-License-Identifier: Apache-2.0
#include "mesh/turn.h"

#include <array>
#include <cmath>

namespace luxo {

Mat3 rotationOf(const Vec4& q) {
  const auto [x, y, z, w] = std::array{q.x, q.y, q.z, q.w};
  return Mat3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),  //
              2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),  //
              2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
}

std::optional<Turn> decomposed(Mat3 linear) {
  Turn turn{.rotation = Vec4(0),
            .scale = Vec3(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]))};
  if (glm::determinant(linear) < 0) turn.scale.x = -turn.scale.x;
  for (int i = 0; i < 3; ++i) {
    if (turn.scale[i] == 0) return std::nullopt;
    linear[i] /= turn.scale[i];
  }
  for (int i = 0; i < 3; ++i)
    if (std::abs(glm::dot(linear[i], linear[(i + 1) % 3])) > 1e-6) return std::nullopt;
  // Shepperd, Quaternion from rotation matrix, 1978: from the largest component.
  const auto [x, y, z] = std::array{linear[0][0], linear[1][1], linear[2][2]};
  const Vec4 squares(1 + x - y - z, 1 - x + y - z, 1 - x - y + z, 1 + x + y + z);
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;
  const double yz = linear[1][2] + linear[2][1], xz = linear[0][2] + linear[2][0],
               xy = linear[0][1] + linear[1][0];
  const double xw = linear[1][2] - linear[2][1], yw = linear[2][0] - linear[0][2],
               zw = linear[0][1] - linear[1][0];
  const Vec4 rows[4] = {
      {squares.x, xy, xz, xw}, {xy, squares.y, yz, yw}, {xz, yz, squares.z, zw}, {xw, yw, zw, squares.w}};
  turn.rotation = rows[largest] / glm::length(rows[largest]);
  return turn;
}

}  // namespace luxo
