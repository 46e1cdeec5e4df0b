// SPDX-License-Identifier: Apache-2.0
#include "surface/normal.h"

#include <array>
#include <cmath>
#include <optional>

#include "surface/spread.h"

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

std::vector<Derivatives> derivativesAt(const SurfaceFunction& function, const Domain& domain,
                                       std::span<const double> u, std::span<const double> v,
                                       std::span<const double> inputs) {
  const auto first = function.tangents.evaluate(u, v, inputs);
  const auto second = function.second.evaluate(u, v, inputs);
  const auto at = [](const auto& values, int k, std::size_t i) {
    return Vec3(values[k][i], values[k + 1][i], values[k + 2][i]);
  };
  const double width = domain.u.width(), height = domain.v.width();
  std::vector<Derivatives> all(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    Derivatives& d = all[i];
    d = {at(first, 3, i), at(first, 6, i), at(second, 0, i), at(second, 3, i), at(second, 6, i)};
    d.scaleU = glm::length(d.duu) * width + glm::length(d.duv) * height;
    d.scaleV = glm::length(d.duv) * width + glm::length(d.dvv) * height;
  }
  return all;
}

/// Comparisons are written so that what is not a number is not regular.
std::optional<Vec3> regularNormal(const Derivatives& d) {
  const Vec3 cross = glm::cross(d.du, d.dv);
  const double lengthU = glm::length(d.du), lengthV = glm::length(d.dv);
  const bool regular = lengthU > kNoise * d.scaleU && lengthV > kNoise * d.scaleV &&
                       glm::length(cross) > kNoise * lengthU * lengthV;
  if (!regular || !isFinite(cross)) return {};
  return unit(cross);
}

/// One domain's size toward the middle.
double inward(double x, const Interval& range) { return x <= range.mid() ? range.width() : -range.width(); }

/// Limit of the normals along a straight line: polynomial extrapolation from four neighbours (Neville); where
/// that does not converge, the nearest neighbour that has a normal.
std::optional<Vec3> limitAlong(const SurfaceFunction& function, const Domain& domain, const Vec2& from,
                               const Vec2& step, std::span<const double> inputs) {
  const auto normalAt = [&](double part) {
    const double u = from.x + part * step.x, v = from.y + part * step.y;
    return regularNormal(derivativesAt(function, domain, {&u, 1}, {&v, 1}, inputs).front());
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
  for (const int exponent : {-38, -30, -20})
    if (const auto normal = normalAt(std::ldexp(1.0, exponent))) return normal;
  return unit(table[3]);
}

/// The limit from inside where the cross product itself is noise.
Vec3 singularNormal(const SurfaceFunction& function, const Domain& domain, const Vec2& at,
                    const Derivatives& d, std::span<const double> inputs) {
  const double towardU = inward(at.x, domain.u), towardV = inward(at.y, domain.v);
  const std::array<Vec2, 3> steps{Vec2(0, towardV), Vec2(towardU, 0), Vec2(towardU, towardV)};
  const double scaleU = glm::length(d.du) + d.scaleU, scaleV = glm::length(d.dv) + d.scaleV;
  for (const Vec2& step : steps) {
    const Vec3 first =
        glm::cross(step.x * d.duu + step.y * d.duv, d.dv) + glm::cross(d.du, step.x * d.duv + step.y * d.dvv);
    if (isFinite(first) && glm::length(first) > kFirstOrderNoise * scaleU * scaleV) return unit(first);
  }
  for (const Vec2& step : steps)
    if (const auto normal = limitAlong(function, domain, at, step, inputs)) return *normal;
  return {0, 1, 0};
}

}  // namespace

Vec3 limitNormal(const SurfaceFunction& function, const Domain& domain, double u, double v,
                 std::span<const double> inputs) {
  return limitNormals(function, domain, {&u, 1}, {&v, 1}, inputs).front();
}

std::vector<Vec3> limitNormals(const SurfaceFunction& function, const Domain& domain,
                               std::span<const double> u, std::span<const double> v,
                               std::span<const double> inputs) {
  const std::vector<Derivatives> derivatives = derivativesAt(function, domain, u, v, inputs);
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto regular = regularNormal(derivatives[i]);
    normals.push_back(regular ? *regular
                              : singularNormal(function, domain, {u[i], v[i]}, derivatives[i], inputs));
  }
  return normals;
}

}  // namespace luxo
