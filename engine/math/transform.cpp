// SPDX-License-Identifier: Apache-2.0
#include "math/transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace luxo {

Transform operator*(const Transform& aFromB, const Transform& bFromC) {
  return {aFromB.linear * bFromC.linear, aFromB.linear * bFromC.translation + aFromB.translation};
}

Vec3 transformPoint(const Transform& t, const Vec3& point) { return t.linear * point + t.translation; }

Vec3 transformDirection(const Transform& t, const Vec3& direction) { return t.linear * direction; }

Mat3 normalMatrix(const Mat3& linear) {
  const Vec3 &a = linear[0], &b = linear[1], &c = linear[2];
  const Mat3 cofactor(glm::cross(b, c), glm::cross(c, a), glm::cross(a, b));
  return glm::dot(a, cofactor[0]) < 0 ? -cofactor : cofactor;
}

double largestStretch(const Mat3& linear) {
  // Eigenvalues of the symmetric B = A^T A in closed form (Smith 1961), after scaling so that nothing
  // overflows.
  double scale = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) scale = std::max(scale, std::abs(linear[column][row]));
  if (!(scale > 0)) return 0;
  const Mat3 a = linear / scale;
  const Mat3 b = glm::transpose(a) * a;
  const double off = b[1][0] * b[1][0] + b[2][0] * b[2][0] + b[2][1] * b[2][1];
  const double mean = (b[0][0] + b[1][1] + b[2][2]) / 3;
  const Vec3 d(b[0][0] - mean, b[1][1] - mean, b[2][2] - mean);
  const double spread = std::sqrt((glm::dot(d, d) + 2 * off) / 6);
  if (spread < 1e-15 * mean) return scale * std::sqrt(mean) * (1 + 1e-12);
  const Mat3 normalised = (b - Mat3(mean)) / spread;
  const double half = std::clamp(glm::determinant(normalised) / 2, -1.0, 1.0);
  const double largest = mean + 2 * spread * std::cos(std::acos(half) / 3);
  return scale * std::sqrt(largest) * (1 + 1e-12);
}

bool mirrors(const Transform& t) { return glm::determinant(t.linear) < 0; }

Mat3 rotation(const Vec3& axis, double angleRadians) {
  const Vec3 d = unit(axis);
  if (!(glm::dot(d, d) > 0.5)) {
    if (axis == Vec3(0) && angleRadians == 0) return Mat3(1);
    throw Error(ErrorKind::Scene,
                fmt::format("cannot rotate by {} rad about the axis ({}, {}, {}): it has no direction",
                            angleRadians, axis.x, axis.y, axis.z),
                "give a finite axis that is not zero");
  }
  const double c = std::cos(angleRadians), s = std::sin(angleRadians);
  const Mat3 outer = glm::outerProduct(d, d);
  const Mat3 cross(Vec3(0, d.z, -d.y), Vec3(-d.z, 0, d.x), Vec3(d.y, -d.x, 0));
  return Mat3(c) + (1 - c) * outer + s * cross;
}

Transform compose(const Vec3& translation, const Mat3& rotation, const Vec3& scale) {
  return {Mat3(rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z), translation};
}

double angleAt(double radiansPerSecond, double timeSeconds) {
  // The product is kept as high + low; the C library's sine and cosine reduce `high` by the true pi at any
  // size.
  const double high = radiansPerSecond * timeSeconds;
  const double low = std::fma(radiansPerSecond, timeSeconds, -high);
  return std::atan2(std::sin(high), std::cos(high)) + low;
}

}  // namespace luxo
