// SPDX-License-Identifier: Apache-2.0
#include "surface/curvature.h"

#include <array>
#include <cmath>

namespace luxo {

std::optional<PrincipalCurvatures> curvatureAt(const Surface& surface, std::uint32_t patch, double u,
                                               double v, std::span<const double> parameters,
                                               const Mat3& worldFromObject) {
  constexpr double kRegular = 1e-6;
  const Patch& of = surface.patches()[patch];
  const PatchInputs inputs(of, parameters);
  std::array<double, 9> first{}, second{};
  of.function->tangents.evaluatePoint(u, v, inputs, first);
  of.function->second.evaluatePoint(u, v, inputs, second);
  const auto in = [&](const std::array<double, 9>& values, std::size_t k) {
    return worldFromObject * Vec3(values[k], values[k + 1], values[k + 2]);
  };
  const Vec3 su = in(first, 3), sv = in(first, 6), suu = in(second, 0), suv = in(second, 3),
             svv = in(second, 6);
  const double width = of.domain.u.width(), height = of.domain.v.width();
  const double lengthU = glm::length(su), lengthV = glm::length(sv), area = glm::length(glm::cross(su, sv));
  // Written so that what is not a number is not regular.
  if (!(lengthU > kRegular * (glm::length(suu) * width + glm::length(suv) * height) &&
        lengthV > kRegular * (glm::length(suv) * width + glm::length(svv) * height) &&
        area > kRegular * lengthU * lengthV))
    return std::nullopt;

  const Vec3 normal = unit(normalMatrix(worldFromObject) * surface.normal(patch, u, v, parameters));
  // In the basis e1 = Su / |Su|, e2 = n x e1 of the tangent plane: Su = a e1, Sv = b e1 + c e2.
  const Vec3 e1 = su / lengthU, e2 = glm::cross(normal, e1);
  const double a = lengthU, b = glm::dot(sv, e1), c = glm::dot(sv, e2);
  const double l = -glm::dot(suu, normal), m = -glm::dot(suv, normal), n = -glm::dot(svv, normal);
  const double b11 = l / (a * a), b12 = (m / a - b * b11) / c;
  const double b22 = (n - 2 * b * m / a + b * b * b11) / (c * c);

  // + 0.0: no -0 of what is flat.
  PrincipalCurvatures k{.gaussian = b11 * b22 - b12 * b12 + 0.0, .mean = 0.5 * (b11 + b22) + 0.0};
  const double half = 0.5 * (b11 - b22), spread = std::hypot(half, b12);
  k.k1 = k.mean + spread;
  k.k2 = k.mean - spread;
  const double angle = 0.5 * std::atan2(b12, half);
  k.direction1 = std::cos(angle) * e1 + std::sin(angle) * e2;
  k.direction2 = glm::cross(normal, k.direction1);
  if (!std::isfinite(k.k1) || !std::isfinite(k.k2)) return std::nullopt;
  return k;
}

}  // namespace luxo
