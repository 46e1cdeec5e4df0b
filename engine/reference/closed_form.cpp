// SPDX-License-Identifier: Apache-2.0
#include "reference/closed_form.h"

#include <algorithm>
#include <cmath>

namespace luxo::reference {
namespace {

constexpr double kAgreement = 1e-12;    // of the size: 10^4 roundings
constexpr double kOnTheEdge = 1e-12;    // of the domain: how far outside a root may be found
constexpr double kRounding = 1 + 1e-9;  // of a reach
constexpr int kSamples = 100;

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

/// 0..1 around the circle.
double turn(double angle) {
  const double part = angle / kTau;
  return part < 0 ? part + 1 : part;
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

/// Tries one form after the other on a patch.
struct ClosedForm::Recognition {
  const Surface& surface;
  std::uint32_t patch;
  std::span<const double> parameters;

  [[nodiscard]] Vec3 at(double u, double v) const { return surface.position(patch, u, v, parameters); }

  [[nodiscard]] ClosedForm form(const Vec3& scale, const Equation& equation, const Parameter& v, double reach,
                                const Parameter& u = {}) const {
    ClosedForm f;
    f.patch_ = patch;
    f.domain_ = surface.patchDomain(patch);
    f.scale_ = scale;
    f.equation_ = equation;
    f.u_ = u;
    f.v_ = v;
    f.reach_ = reach * kRounding;
    return f;
  }

  [[nodiscard]] ClosedForm rectangle() const {
    return form({2 * at(1, 0.5).x, 1, -2 * at(0.5, 1).z}, {.y = 1}, {Along::Z, 0.5, -1}, 1,
                {Along::X, 0.5, 1});
  }
  [[nodiscard]] ClosedForm saddle() const {
    return form({at(1, 0.5).x, at(1, 0.5).y, -at(0.5, 1).z}, {.xx = -1, .zz = 1, .y = 1},
                {Along::Z, 0.5, -0.5}, 2, {Along::X, 0.5, 0.5});
  }
  [[nodiscard]] ClosedForm disk() const {
    const double radius = at(0, 1).x;
    return form({radius, radius, radius}, {.y = 1}, {Along::Radius, 0, 1}, 1);
  }
  [[nodiscard]] ClosedForm cone() const {  // and the cylinder
    const double bottom = at(0, 0).x, top = at(0, 1).x, widest = std::max(bottom, top);
    const double r = bottom / widest, slope = (top - bottom) / widest;
    return form({widest, at(0, 1).y, widest},
                {.xx = 1, .yy = -slope * slope, .zz = 1, .y = -2 * r * slope, .constant = -r * r},
                {Along::Y, 0, 1}, std::sqrt(2.0));
  }
  [[nodiscard]] ClosedForm ellipsoid() const {
    return form({at(0, 0.5).x, at(0, 1).y, -at(0.25, 0.5).z}, {.xx = 1, .yy = 1, .zz = 1, .constant = -1},
                {Along::Latitude, 0.5, 1}, 1);
  }
  [[nodiscard]] ClosedForm paraboloid() const {
    const Vec3 rim = at(0, 1);
    return form({rim.x, rim.y, rim.x}, {.xx = 1, .zz = 1, .y = -1}, {Along::Radius, 0, 1}, std::sqrt(2.0));
  }
  [[nodiscard]] ClosedForm oneSheet() const {
    const double waist = at(0, 0.5).x, rim = at(0, 1).x / waist;
    return form({waist, at(0, 1).y, waist}, {.xx = 1, .yy = 1 - rim * rim, .zz = 1, .constant = -1},
                {Along::Y, 0.5, 0.5}, std::hypot(rim, 1));
  }
  [[nodiscard]] ClosedForm sheetOfTwo(double side) const {
    const double vertex = at(0, 0.5).y * side, radius = at(0, 0.5 + 0.5 * side).x;
    const double rim = at(0, 0.5 + 0.5 * side).y * side / vertex, opening = rim * rim - 1;
    ClosedForm f = form({radius, vertex, radius}, {.xx = -opening, .yy = 1, .zz = -opening, .constant = -1},
                        {Along::Radius, 0.5, 0.5 * side}, std::hypot(rim, 1));
    f.sheet_ = side;
    return f;
  }
  [[nodiscard]] ClosedForm torus() const {
    const double outer = at(0, 0).x, inner = at(0, 0.5).x, ring = 0.5 * (outer + inner);
    ClosedForm f = form(Vec3(ring), {}, {Along::Tube, 0, 1}, outer / ring);
    f.tube_ = 0.5 * (outer - inner) / ring;
    return f;
  }
};

std::optional<ClosedForm> ClosedForm::of(const Surface& surface, std::uint32_t patch,
                                         std::span<const double> parameters) {
  const Recognition r{surface, patch, parameters};
  const auto forms = {&Recognition::rectangle, &Recognition::disk,  &Recognition::cone,
                      &Recognition::ellipsoid, &Recognition::torus, &Recognition::paraboloid,
                      &Recognition::oneSheet,  &Recognition::saddle};
  for (const auto candidate : forms)
    if (ClosedForm f = (r.*candidate)(); f.agrees(surface, parameters)) return f;
  for (const double side : {-1.0, 1.0})
    if (ClosedForm f = r.sheetOfTwo(side); f.agrees(surface, parameters)) return f;
  return std::nullopt;
}

bool ClosedForm::agrees(const Surface& surface, std::span<const double> parameters) {
  for (int i = 0; i < 3; ++i)
    if (!(scale_[i] > 0 && std::isfinite(scale_[i]))) return false;
  if (u_.along == Along::Turn && domain_.u != Interval(0, 1)) return false;
  double side = 0;
  for (int k = 0; k < kSamples; ++k) {
    // Inside, spread evenly (M. Roberts 2018), and the edges of v, which are never inside by chance.
    const double u = std::fmod(0.5 + k / 1.32471795724474602596, 1.0);
    const double part = k % 10 == 0 ? (k % 20) / 10.0 : std::fmod(0.5 + k / 1.75487766624669276005, 1.0);
    const double v = domain_.v.lo + part * domain_.v.width(), inU = domain_.u.lo + u * domain_.u.width();
    const Vec3 p = surface.position(patch_, inU, v, parameters), unitPoint = p / scale_;
    const Vec3 steep = gradient(unitPoint);
    if (!(std::abs(at(unitPoint)) <= kAgreement * reach_ * (glm::length(steep) + kAgreement))) return false;
    if (!(glm::length(unitPoint) <= reach_) || sheet_ * unitPoint.y < 0) return false;
    const Vec2 back = parametersOf(unitPoint);
    if (!(glm::length(surface.position(patch_, back.x, back.y, parameters) - p) <= kAgreement * radius()))
      return false;
    side += glm::dot(surface.normal(patch_, inU, v, parameters) * scale_, steep);
  }
  outward_ = side < 0 ? -1 : 1;
  return true;
}

double ClosedForm::radius() const { return reach_ * std::max({scale_.x, scale_.y, scale_.z}); }

double ClosedForm::at(const Vec3& p) const {
  if (tube_ == 0)
    return equation_.xx * p.x * p.x + equation_.yy * p.y * p.y + equation_.zz * p.z * p.z +
           equation_.y * p.y + equation_.constant;
  const double sum = glm::dot(p, p) + (1 - tube_) * (1 + tube_);
  return sum * sum - 4 * (p.x * p.x + p.z * p.z);
}

Vec3 ClosedForm::gradient(const Vec3& p) const {
  if (tube_ == 0)
    return {2 * equation_.xx * p.x, 2 * equation_.yy * p.y + equation_.y, 2 * equation_.zz * p.z};
  return 4 * (glm::dot(p, p) + (1 - tube_) * (1 + tube_)) * p - 8.0 * Vec3(p.x, 0, p.z);
}

double ClosedForm::parameter(const Parameter& p, const Vec3& q) const {
  const double radius = std::hypot(q.x, q.z);
  switch (p.along) {
    case Along::X:
      return p.start + p.rate * q.x;
    case Along::Y:
      return p.start + p.rate * q.y;
    case Along::Z:
      return p.start + p.rate * q.z;
    case Along::Radius:
      return p.start + p.rate * radius;
    case Along::Turn:
      return turn(std::atan2(-q.z, q.x));
    case Along::Latitude:
      return p.start + std::atan2(q.y, radius) / kPi;
    case Along::Tube:
      break;
  }
  return turn(std::atan2(q.y, radius - 1));
}

Interval ClosedForm::parameter(const Parameter& p, const IntervalVec& q) const {
  switch (p.along) {
    case Along::X:
      return p.start + p.rate * q[0];
    case Along::Y:
      return p.start + p.rate * q[1];
    case Along::Z:
      return p.start + p.rate * q[2];
    case Along::Radius:
      return p.start + p.rate * sqrt(square(q[0]) + square(q[2]));
    case Along::Turn:  // all of the circle and of the meridian belong to the patch
    case Along::Latitude:
    case Along::Tube:
      break;
  }
  return 0.5;
}

Vec2 ClosedForm::parametersOf(const Vec3& q) const {
  return {std::clamp(parameter(u_, q), domain_.u.lo, domain_.u.hi),
          std::clamp(parameter(v_, q), domain_.v.lo, domain_.v.hi)};
}

std::optional<bool> ClosedForm::contains(const IntervalVec& q) const {
  const auto inside = [&](const Parameter& p, const Interval& domain) -> std::optional<bool> {
    const Interval x = parameter(p, q);
    const double slack = kOnTheEdge * domain.width(), lo = domain.lo - slack, hi = domain.hi + slack;
    if (x.hi < lo || x.lo > hi) return false;
    if (x.lo >= lo && x.hi <= hi) return true;
    return std::nullopt;
  };
  if (sheet_ != 0 && (sheet_ * q[1]).hi < 0) return false;
  const auto inU = inside(u_, domain_.u), inV = inside(v_, domain_.v);
  if (inU == false || inV == false) return false;
  return inU && inV ? std::optional(true) : std::nullopt;
}

ClosedForm::Answer ClosedForm::nearestRoot(const ObjectRay& ray, const RootQuery& query) const {
  // In the form's own units, from where the ray comes closest to the middle: nothing large is left to cancel.
  IntervalVec origin = ray.origin, direction = ray.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval scale(scale_[static_cast<int>(i)]);
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
  const double reach = reach_ + 2 * aside.magnitude();
  if (dot(origin, origin).lo > reach * reach) return {};

  const auto [coefficients, count] = polynomialAlong(origin, direction);
  const RealRoots roots = realRoots(std::span(coefficients).first(count), reach);
  if (!roots.decided) return {.decided = false};
  for (const RealRoot& root : roots.all()) {
    if (query.facing == Facing::Front && root.rising == (outward_ > 0)) continue;
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
  if (tube_ == 0) {
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
                 c = dot(o, o) + (Interval(1) - tube_) * (Interval(1) + tube_);
  const Interval flat = o[0] * d[0] + o[2] * d[2];
  return {{square(c) - 4 * (square(o[0]) + square(o[2])), 2 * (b * c) - 8 * flat,
           square(b) + 2 * (a * c) - 4 * (square(d[0]) + square(d[2])), 2 * (a * b), square(a)},
          5};
}

double ClosedForm::polished(const RealRoot& root, const Vec3& origin, const Vec3& direction) const {
  double s = root.at.mid();
  if (tube_ == 0) return s;
  // Of a thin tube the quartic loses digits; the distance to its middle does not.
  for (int step = 0; step < 2; ++step) {
    const Vec3 p = origin + s * direction;
    const double radius = std::hypot(p.x, p.z), off = radius - 1, distance = std::hypot(off, p.y);
    const double slope =
        (off * (p.x * direction.x + p.z * direction.z) / radius + p.y * direction.y) / distance;
    const double next = s - (distance - tube_) / slope;
    if (!root.at.contains(next)) break;
    s = next;
  }
  return s;
}

}  // namespace luxo::reference
