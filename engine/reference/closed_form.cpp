// SPDX-License-Identifier: Apache-2.0
#include "reference/closed_form.h"

#include <algorithm>
#include <cmath>

namespace luxo::reference {
namespace {

constexpr double kRounding = 1 + 1e-9;  // of a reach

IntervalVec intervals(const Vec3& p) { return {p.x, p.y, p.z}; }
Vec3 middleOf(const IntervalVec& p) { return {p[0].mid(), p[1].mid(), p[2].mid()}; }

Interval dot(const IntervalVec& a, const IntervalVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

IntervalVec cross(const IntervalVec& a, const IntervalVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

IntervalVec along(const IntervalVec& from, const Interval& distance, const IntervalVec& direction) {
  return {from[0] + distance * direction[0], from[1] + distance * direction[1],
          from[2] + distance * direction[2]};
}

/// A parameter that is not whole; of one that is, any.
Interval parameter(const Equation::Parameter& p, const IntervalVec& q) {
  switch (p.along) {
    case Equation::Along::X:
      return p.start + p.rate * q[0];
    case Equation::Along::Y:
      return p.start + p.rate * q[1];
    case Equation::Along::Z:
      return p.start + p.rate * q[2];
    case Equation::Along::Radius:
      return p.start + p.rate * sqrt(square(q[0]) + square(q[2]));
    case Equation::Along::Turn:  // all of the circle and of the meridian belong to the patch
    case Equation::Along::Latitude:
    case Equation::Along::Tube:
      break;
  }
  return 0.5;
}

}  // namespace

std::optional<ObjectFromWorld> ObjectFromWorld::of(const Transform& worldFromObject) {
  const Mat3& m = worldFromObject.linear;
  const IntervalVec a = intervals(m[0]), b = intervals(m[1]), c = intervals(m[2]);
  const Interval determinant = dot(a, cross(b, c));
  if (determinant.contains(0)) return std::nullopt;
  ObjectFromWorld inverse;
  inverse.translation_ = worldFromObject.translation;
  inverse.rows_ = {cross(b, c), cross(c, a), cross(a, b)};
  for (IntervalVec& row : inverse.rows_)
    for (Interval& x : row) x = x / determinant;
  return inverse;
}

ObjectRay ObjectFromWorld::operator()(const Ray& ray) const {
  IntervalVec from;
  for (int i = 0; i < 3; ++i)
    from[static_cast<std::size_t>(i)] = Interval(ray.origin[i]) - Interval(translation_[i]);
  const IntervalVec direction = intervals(ray.direction);
  return {{dot(rows_[0], from), dot(rows_[1], from), dot(rows_[2], from)},
          {dot(rows_[0], direction), dot(rows_[1], direction), dot(rows_[2], direction)}};
}

std::optional<ClosedForm> ClosedForm::of(const Surface& surface, std::uint32_t patch,
                                         std::span<const double> parameters) {
  const std::optional<Equation> equation = equationOf(surface, patch, parameters);
  return equation ? std::optional(ClosedForm(*equation, patch, surface.patchDomain(patch))) : std::nullopt;
}

double ClosedForm::radius() const {
  const Vec3& scale = equation_.scale;
  return equation_.reach * kRounding * std::max({scale.x, scale.y, scale.z});
}

Vec2 ClosedForm::parametersOf(const Vec3& unitPoint) const {
  const Vec2 uv = equation_.parametersOf(unitPoint);
  return {std::clamp(uv.x, domain_.u.lo, domain_.u.hi), std::clamp(uv.y, domain_.v.lo, domain_.v.hi)};
}

std::optional<bool> ClosedForm::contains(const IntervalVec& q) const {
  const auto inside = [&](const Equation::Parameter& p, const Interval& domain) -> std::optional<bool> {
    const Interval x = parameter(p, q);
    const double slack = kOnTheEdge * domain.width(), lo = domain.lo - slack, hi = domain.hi + slack;
    if (x.hi < lo || x.lo > hi) return false;
    if (x.lo >= lo && x.hi <= hi) return true;
    return std::nullopt;
  };
  if (equation_.sheet != 0 && (equation_.sheet * q[1]).hi < 0) return false;
  const auto inU = inside(equation_.u, domain_.u), inV = inside(equation_.v, domain_.v);
  if (inU == false || inV == false) return false;
  return inU && inV ? std::optional(true) : std::nullopt;
}

ClosedForm::Answer ClosedForm::nearestRoot(const ObjectRay& ray, const RootQuery& query) const {
  // In the form's own units, from where the ray comes closest to the middle: nothing large is left to cancel.
  IntervalVec origin = ray.origin, direction = ray.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval scale(equation_.scale[static_cast<int>(i)]);
    origin[i] = origin[i] / scale;
    direction[i] = direction[i] / scale;
  }
  const double speed = glm::length(middleOf(direction));  // units per metre
  if (!(speed > 0 && std::isfinite(speed))) return {.decided = false};
  const double closest = -glm::dot(middleOf(origin), middleOf(direction)) / (speed * speed);
  if (!std::isfinite(closest)) return {.decided = false};
  origin = along(origin, closest, direction);
  for (Interval& x : direction) x = x / speed;
  const Interval aside = dot(origin, direction);  // 0 but for rounding
  const double reach = equation_.reach * kRounding + 2 * aside.magnitude();
  if (dot(origin, origin).lo > reach * reach) return {};

  const auto [coefficients, count] = polynomialAlong(origin, direction);
  const RealRoots roots = realRoots(std::span(coefficients).first(count), reach);
  if (!roots.decided) return {.decided = false};
  for (const RealRoot& root : roots.all()) {
    if (query.facing == Facing::Front && root.rising == (equation_.outward > 0)) continue;
    const double s = polished(root, middleOf(origin), middleOf(direction)), t = closest + s / speed;
    if (!(t >= query.nearest)) continue;
    if (!(t <= query.farthest)) break;
    const std::optional<bool> inside = contains(along(origin, root.at, direction));
    if (!inside) return {.decided = false};
    if (!*inside) continue;
    const Vec2 uv = parametersOf(middleOf(origin) + s * middleOf(direction));
    return {.nearest = Root{t, patch_, uv.x, uv.y}};
  }
  return {};
}

std::pair<std::array<Interval, 5>, std::size_t> ClosedForm::polynomialAlong(const IntervalVec& o,
                                                                            const IntervalVec& d) const {
  if (equation_.form() == Equation::Form::Quadric) {
    const Equation& e = equation_;
    const IntervalVec weights = {e.xx, e.yy, e.zz};
    const IntervalVec weighted = {weights[0] * d[0], weights[1] * d[1], weights[2] * d[2]};
    return {{weights[0] * square(o[0]) + weights[1] * square(o[1]) + weights[2] * square(o[2]) + e.y * o[1] +
                 e.constant,
             2 * dot(weighted, o) + e.y * d[1], dot(weighted, d)},
            3};
  }
  // (|p|^2 + 1 - tube^2)^2 - 4 (x^2 + z^2), with |p|^2 + 1 - tube^2 = a s^2 + b s + c.
  const Interval a = dot(d, d), b = 2 * dot(o, d),
                 c = dot(o, o) + (Interval(1) - equation_.tube) * (Interval(1) + equation_.tube);
  const Interval flat = o[0] * d[0] + o[2] * d[2];
  return {{square(c) - 4 * (square(o[0]) + square(o[2])), 2 * (b * c) - 8 * flat,
           square(b) + 2 * (a * c) - 4 * (square(d[0]) + square(d[2])), 2 * (a * b), square(a)},
          5};
}

double ClosedForm::polished(const RealRoot& root, const Vec3& origin, const Vec3& direction) const {
  double s = root.at.mid();
  if (equation_.form() == Equation::Form::Quadric) return s;
  // Of a thin tube the quartic loses digits; the distance to its middle does not.
  for (int step = 0; step < 2; ++step) {
    const Vec3 p = origin + s * direction;
    const double radius = std::hypot(p.x, p.z), off = radius - 1, distance = std::hypot(off, p.y);
    const double slope =
        (off * (p.x * direction.x + p.z * direction.z) / radius + p.y * direction.y) / distance;
    const double next = s - (distance - equation_.tube) / slope;
    if (!root.at.contains(next)) break;
    s = next;
  }
  return s;
}

}  // namespace luxo::reference
