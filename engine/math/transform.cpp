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
  double scale = 0;  // taken out so that nothing overflows
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) scale = std::max(scale, std::abs(linear[column][row]));
  if (!(scale > 0)) return 0;
  // Pairs of columns are turned until all are orthogonal (Hestenes 1958): the turns change no singular value,
  // and the lengths of orthogonal columns are the singular values. Unlike the roots of the characteristic
  // polynomial, the lengths stay accurate when stretches are equal.
  Mat3 a = linear / scale;
  constexpr int kMaxSweeps = 16;  // convergence is quadratic: six are usual
  bool turned = true;
  for (int sweep = 0; turned && sweep < kMaxSweeps; ++sweep) {
    turned = false;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const double pp = glm::dot(a[p], a[p]), qq = glm::dot(a[q], a[q]), pq = glm::dot(a[p], a[q]);
        if (pq * pq <= 1e-30 * pp * qq) continue;
        turned = true;
        const double cot = (qq - pp) / (2 * pq);  // of twice the angle
        const double tan = std::copysign(1 / (std::abs(cot) + std::hypot(1, cot)), cot);
        const double cos = 1 / std::sqrt(1 + tan * tan);
        const Vec3 column = a[p];
        a[p] = cos * (column - tan * a[q]);
        a[q] = cos * (a[q] + tan * column);
      }
  }
  return scale * std::max({glm::length(a[0]), glm::length(a[1]), glm::length(a[2])}) * (1 + 1e-12);
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
  // The product is high + low exactly; the C library's sine and cosine reduce each by the true pi at any
  // size, and the addition theorems join them.
  const double high = radiansPerSecond * timeSeconds;
  const double low = std::fma(radiansPerSecond, timeSeconds, -high);
  const double sh = std::sin(high), ch = std::cos(high), sl = std::sin(low), cl = std::cos(low);
  return std::atan2(sh * cl + ch * sl, ch * cl - sh * sl);
}

}  // namespace luxo
