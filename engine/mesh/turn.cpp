// SPDX-License-Identifier: Apache-2.0
#include "mesh/turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "math/basis.h"

namespace luxo {

Mat3 rotationOf(const Vec4& q) {
  const auto [x, y, z, w] = std::array{q.x, q.y, q.z, q.w};
  return Mat3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),  //
              2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),  //
              2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
}

namespace {

/// Of an orthogonal map that mirrors nothing.
Vec4 quaternionOf(const Mat3& rotation) {
  // Shepperd, Quaternion from rotation matrix, 1978: from the largest component.
  const auto [x, y, z] = std::array{rotation[0][0], rotation[1][1], rotation[2][2]};
  const Vec4 squares(1 + x - y - z, 1 - x + y - z, 1 - x - y + z, 1 + x + y + z);
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;
  const double yz = rotation[1][2] + rotation[2][1], xz = rotation[0][2] + rotation[2][0],
               xy = rotation[0][1] + rotation[1][0];
  const double xw = rotation[1][2] - rotation[2][1], yw = rotation[2][0] - rotation[0][2],
               zw = rotation[0][1] - rotation[1][0];
  const Vec4 rows[4] = {
      {squares.x, xy, xz, xw}, {xy, squares.y, yz, yw}, {xz, yz, squares.z, zw}, {xw, yw, zw, squares.w}};
  return rows[largest] / glm::length(rows[largest]);
}

/// Turns two columns in their plane until they are perpendicular, and the rotation along.
void makePerpendicular(Mat3& columns, Mat3& rotation, int p, int q) {
  const double along = glm::dot(columns[p], columns[q]);
  if (along == 0) return;
  const double tau = (glm::dot(columns[q], columns[q]) - glm::dot(columns[p], columns[p])) / (2 * along);
  const double tangent = std::copysign(1 / (std::abs(tau) + std::hypot(1, tau)), tau);
  const double cosine = 1 / std::hypot(1, tangent), sine = cosine * tangent;
  for (Mat3* m : {&columns, &rotation}) {
    const Vec3 left = (*m)[p], right = (*m)[q];
    (*m)[p] = cosine * left - sine * right;
    (*m)[q] = sine * left + cosine * right;
  }
}

}  // namespace

SingularValues singularValues(Mat3 linear) {
  Mat3 first(1);
  // It converges quadratically: of a million random matrices none needed more than 7 sweeps to the last bit.
  for (int sweep = 0; sweep < 12; ++sweep)
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
      makePerpendicular(linear, first, p, q);

  std::array<int, 3> order = {0, 1, 2};
  std::ranges::sort(order, std::greater(), [&](int i) { return glm::dot(linear[i], linear[i]); });
  const auto [longest, middle, shortest] = order;
  Mat3 axes;
  axes[longest] = glm::length(linear[longest]) > 0 ? unit(linear[longest]) : Vec3(1, 0, 0);
  axes[middle] = completed(axes[longest])[0];
  if (glm::length(linear[middle]) > 1e-15 * glm::length(linear[longest])) axes[middle] = unit(linear[middle]);
  axes[shortest] = glm::cross(axes[(shortest + 1) % 3], axes[(shortest + 2) % 3]);
  return {.turn = {.rotation = quaternionOf(axes),
                   .scale = {glm::dot(axes[0], linear[0]), glm::dot(axes[1], linear[1]),
                             glm::dot(axes[2], linear[2])}},
          .first = quaternionOf(glm::transpose(first))};
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
  turn.rotation = quaternionOf(linear);
  return turn;
}

}  // namespace luxo
