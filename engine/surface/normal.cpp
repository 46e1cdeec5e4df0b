// SPDX-License-Identifier: Apache-2.0
#include "surface/normal.h"

#include <array>
#include <cmath>
#include <optional>

namespace luxo {
namespace {

/// Relative size below which a tangent or a cross product is rounding noise, not a direction.
constexpr double kNoise = 1e-12;
/// The same for a first-order term: it is as accurate as its second derivatives.
constexpr double kFirstOrderNoise = 1e-9;
/// What extrapolation may still change; more means that it does not converge (a fractional power).
constexpr double kConverged = 1e-6;

struct Derivatives {
  Vec3 du, dv, duu, duv, dvv;
  double scaleU = 0, scaleV = 0;  ///< what du and dv are compared with to tell them from noise
};

Derivatives derivativesAt(const SurfaceFunction& function, const Domain& domain, double u, double v,
                          std::span<const double> inputs) {
  const auto first = function.tangents.evaluate({&u, 1}, {&v, 1}, inputs);
  const auto second = function.second.evaluate({&u, 1}, {&v, 1}, inputs);
  const auto at = [](const auto& values, int k) {
    return Vec3(values[k][0], values[k + 1][0], values[k + 2][0]);
  };
  Derivatives d{at(first, 3), at(first, 6), at(second, 0), at(second, 3), at(second, 6)};
  const double width = domain.u.width(), height = domain.v.width();
  d.scaleU = glm::length(d.duu) * width + glm::length(d.duv) * height;
  d.scaleV = glm::length(d.duv) * width + glm::length(d.dvv) * height;
  return d;
}

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Comparisons are written so that what is not a number is not regular.
std::optional<Vec3> regularNormal(const Derivatives& d) {
  const Vec3 cross = glm::cross(d.du, d.dv);
  const double lengthU = glm::length(d.du), lengthV = glm::length(d.dv);
  const bool regular = lengthU > kNoise * d.scaleU && lengthV > kNoise * d.scaleV &&
                       glm::length(cross) > kNoise * lengthU * lengthV;
  if (!regular || !finite(cross)) return {};
  return unit(cross);
}

/// One domain's size toward the middle.
double inward(double x, const Interval& range) { return x <= range.mid() ? range.width() : -range.width(); }

/// Limit of the normals along a straight line: polynomial extrapolation from four neighbours (Neville); where
/// that does not converge, the nearest neighbour that has a normal.
std::optional<Vec3> limitAlong(const SurfaceFunction& function, const Domain& domain, const Vec2& from,
                               const Vec2& step, std::span<const double> inputs) {
  const auto normalAt = [&](double part) {
    return regularNormal(
        derivativesAt(function, domain, from.x + part * step.x, from.y + part * step.y, inputs));
  };
  std::array<double, 4> parts{};
  std::array<Vec3, 4> table{};
  for (int k = 0; k < 4; ++k) {
    parts[k] = std::ldexp(1.0, -9 - k);
    const auto normal = normalAt(parts[k]);
    if (!normal) return {};
    table[k] = *normal;
  }
  double change = 0;
  for (int level = 1; level < 4; ++level) {
    const Vec3 before = table[3];
    for (int k = 3; k >= level; --k)
      table[k] += parts[k] / (parts[k - level] - parts[k]) * (table[k] - table[k - 1]);
    change = glm::length(table[3] - before);
  }
  if (change < kConverged) return unit(table[3]);
  for (const int exponent : {-44, -30, -20})
    if (const auto normal = normalAt(std::ldexp(1.0, exponent))) return normal;
  return unit(table[3]);
}

}  // namespace

Vec3 limitNormal(const SurfaceFunction& function, const Domain& domain, double u, double v,
                 std::span<const double> inputs) {
  const Derivatives d = derivativesAt(function, domain, u, v, inputs);
  if (const auto normal = regularNormal(d)) return *normal;

  const double towardU = inward(u, domain.u), towardV = inward(v, domain.v);
  const std::array<Vec2, 3> steps{Vec2(0, towardV), Vec2(towardU, 0), Vec2(towardU, towardV)};
  const double scaleU = glm::length(d.du) + d.scaleU, scaleV = glm::length(d.dv) + d.scaleV;
  for (const Vec2& step : steps) {
    const Vec3 first =
        glm::cross(step.x * d.duu + step.y * d.duv, d.dv) + glm::cross(d.du, step.x * d.duv + step.y * d.dvv);
    if (finite(first) && glm::length(first) > kFirstOrderNoise * scaleU * scaleV) return unit(first);
  }
  for (const Vec2& step : steps)
    if (const auto normal = limitAlong(function, domain, {u, v}, step, inputs)) return *normal;
  return {0, 1, 0};
}

}  // namespace luxo
